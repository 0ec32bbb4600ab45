#include "features/postures/likeness_meter.h"

#include "handway/geometric/io/resources.h"
#include "model/document/document.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/menu_text.h"
#include "widgets/style/theme.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QVariant>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kNameWidth = 144;
constexpr int kNumberWidth = 44;
constexpr int kThickness = 6;  // px
constexpr int kMarkHeight = 14;

}  // namespace

class DistanceRow::Bar : public QWidget {
 public:
  void show_distance(std::optional<double> distance, std::optional<double> usual) {
    distance_ = distance;
    usual_ = usual;
    update();
  }
  [[nodiscard]] QSize sizeHint() const override { return {80, kMarkHeight + 4}; }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QWidget::paintEvent(event);
    const ThemeColors colors = colors_of(current_theme());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    const double top = 0.5 * (height() - kThickness);
    const auto fill = [&](double part, const QColor& color) {
      painter.setBrush(color);
      painter.drawRoundedRect(QRectF(0.0, top, part * width(), kThickness), 3.0, 3.0);
    };
    fill(1.0, colors.border);
    if (distance_) {
      fill(std::clamp(*distance_ / kMost, 0.0, 1.0), colors.accent);
    }
    if (usual_ && *usual_ < kMost) {
      painter.setBrush(colors.text);
      painter.drawRect(
          QRectF(*usual_ / kMost * width() - 1.0, 0.5 * (height() - kMarkHeight), 2, kMarkHeight));
    }
  }

 private:
  std::optional<double> distance_;
  std::optional<double> usual_;
};

DistanceRow::DistanceRow(const QString& name, QWidget* parent)
    : QWidget(parent), bar_(new Bar), number_(new QLabel) {
  auto* label = new QLabel(name);
  label->setFixedWidth(scaled(kNameWidth));
  number_->setMinimumWidth(scaled(kNumberWidth));
  number_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  lay_out(*this, in_row({label, {bar_, 1}, number_}, 8));
  show_distance(std::nullopt);
}

void DistanceRow::show_distance(std::optional<double> distance, std::optional<double> usual) {
  bar_->show_distance(distance, usual);
  number_->setText(distance ? QString::number(*distance, 'f', 3) : QString(QChar(0x2013)));
}

QString DistanceRow::text() const { return number_->text(); }

LikenessMeter::LikenessMeter(RecordedHand& recorded, QWidget* parent)
    : QWidget(parent),
      recorded_(recorded),
      to_subspace_(named("likeness_subspace", new DistanceRow(tr("To the PMD subspace")))),
      to_recorded_(named("likeness_recorded", new DistanceRow(tr("To recorded postures")))),
      note_(named("likeness_note", note())),
      take_(named("likeness_take", new QPushButton(tr("Use the nearest")))),
      choose_(named("likeness_choose", new QPushButton(tr("Postures")))) {
  QLabel* title = heading(tr("Human-likeness"));
  title->setToolTip(tr("Distances in normalised joints; smaller is more human-like"));
  to_subspace_->setToolTip(
      tr("Distance of the hand from the subspace of its free joints and principal motion "
         "directions, in normalised joints"));
  to_recorded_->setToolTip(
      tr("Distance of the hand from the nearest recorded posture of a person, in normalised "
         "joints, without the basis' free joints"));
  note_->setWordWrap(true);
  take_->setToolTip(tr("Move the hand to the nearest recorded posture"));
  choose_->setToolTip(tr("Compare with other postures, as handway pca --postures writes them"));
  lay_out(*this,
          in_column({title, to_subspace_, to_recorded_, note_, in_row({take_, choose_, room()}, 8)},
                    5));
  connect(&recorded_, &RecordedHand::changed, this, &LikenessMeter::compare);
  choose_->setMenu(make_choices());
  connect(take_, &QPushButton::clicked, this, [this] {
    if (const auto nearest = likeness_ ? likeness_->nearest_recorded(q_) : std::nullopt) {
      emit configuration_edited(*nearest);
    }
  });
  hide();
}

void LikenessMeter::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                             std::shared_ptr<const sampling::PmdBasis> basis,
                             const std::vector<int>& hand) {
  likeness_.reset();
  model_ = std::move(model);
  basis_ = std::move(basis);
  hand_ = hand;
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  setVisible(basis_ != nullptr);
  compare();
}

void LikenessMeter::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  show_distances();
}

void LikenessMeter::compare() {
  likeness_.reset();
  if (!basis_) {
    return;
  }
  // The postures that were read may belong to the previous hand.
  const auto postures = recorded_.basis() == basis_ ? recorded_.postures() : nullptr;
  likeness_.emplace(*model_, hand_, *basis_, postures);
  take_->setEnabled(postures != nullptr);
  note_->setText(note_text());
  show_distances();
}

void LikenessMeter::show_distances() {
  if (!likeness_) {
    return;
  }
  const planning::HandLikeness here = likeness_->at(q_);
  to_subspace_->show_distance(
      here.to_subspace, recorded_.postures()
                            ? std::optional(recorded_.postures()->usual_distance_to_subspace())
                            : std::nullopt);
  to_recorded_->show_distance(here.to_recorded);
}

QString LikenessMeter::note_text() const {
  switch (recorded_.state()) {
    case RecordedHand::State::kNone:
      return tr("The basis names no recorded postures. Choose a file of postures to compare with.");
    case RecordedHand::State::kReading:
      return tr("Reading the recorded postures…");
    case RecordedHand::State::kFailed:
      return tr("The recorded postures can't be read: %1").arg(recorded_.fault());
    case RecordedHand::State::kReady:
      break;
  }
  const sampling::RecordedPostures& postures = *recorded_.postures();
  return tr("%1 recorded postures; 19 of 20 are no farther from the subspace than %2 (mark).")
      .arg(QLocale().toString(static_cast<qlonglong>(postures.count())))
      .arg(postures.usual_distance_to_subspace(), 0, 'f', 2);
}

QMenu* LikenessMeter::make_choices() {
  auto* menu = new QMenu(this);
  const QDir shipped(QString::fromStdString((geometric::resource_dir() / "bases").string()));
  for (const QFileInfo& file : shipped.entryInfoList({QStringLiteral("*_postures.csv")})) {
    menu->addAction(menu_text(file.completeBaseName().remove(QStringLiteral("_postures"))), this,
                    [this, file] { recorded_.choose(file.filePath().toStdString()); });
  }
  menu->addSeparator();
  menu->addAction(tr("From a file…"), this, &LikenessMeter::ask_for_file);
  return menu;
}

void LikenessMeter::ask_for_file() {
  const QString file = QFileDialog::getOpenFileName(window(), tr("Compare with recorded postures"),
                                                    {}, tr("Postures (*.csv)"));
  if (!file.isEmpty()) {
    recorded_.choose(file.toStdString());
  }
}

}  // namespace handway::gui
