#include "features/editing/array_tool.h"

#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/resizing.h"
#include "handway/planning/edits/scene_edits.h"
#include "model/document/scene_editor.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kWidth = 270;
constexpr int kCardMargin = 12;
constexpr int kMostInARow = 50;
constexpr double kFarthest = 100.0;  // m

// Room for a hand between the copies, in round numbers.
double roomy(double size) { return std::ceil((size + 0.05) / 0.01) * 0.01; }

}  // namespace

ArrayCard::ArrayCard(QWidget* host)
    : FloatingCard(host, "array_card", "offer"),
      title_(heading()),
      kind_(named("array_kind", new QComboBox)),
      pages_(new QStackedWidget),
      group_(named("array_group", new QCheckBox(tr("Put all into a group")))),
      note_(note({})),
      make_(named("array_make", new QPushButton(tr("Make copies")))) {
  kind_->addItems({tr("In rows"), tr("Around an axis")});
  pages_->addWidget(make_rows());
  pages_->addWidget(make_circle());
  make_->setProperty("role", "primary");
  QToolButton* close_button = make_close("array_close", tr("Make no copies (Esc)"));
  lay_out(*this,
          in_column({in_row({{title_, 1}, {close_button, 0, Qt::AlignTop}}), kind_, pages_, group_,
                     note_, make_},
                    8),
          {12, 6, 8, 10});

  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int page) {
    pages_->setCurrentIndex(page);
    place();
    emit changed();
  });
  connect(make_, &QPushButton::clicked, this, &ArrayCard::accepted);
  connect(close_button, &QToolButton::clicked, this, &ArrayCard::close);
}

QuantityField* ArrayCard::add_field(const char* name, bool is_angle) {
  using Kind = QuantityField::Kind;
  const double most = is_angle ? 2.0 * std::numbers::pi : kFarthest;
  auto* field = new QuantityField(is_angle ? Kind::kAngle : Kind::kLength, -most, most);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setObjectName(QLatin1String(name));
  connect(field, &QuantityField::quantity_edited, this, &ArrayCard::changed);
  return field;
}

QSpinBox* ArrayCard::add_count(const char* name, int least) {
  auto* count = new QSpinBox;
  count->setObjectName(QLatin1String(name));
  count->setRange(least, kMostInARow);
  connect(count, qOverload<int>(&QSpinBox::valueChanged), this, &ArrayCard::changed);
  return count;
}

QWidget* ArrayCard::make_rows() {
  auto* page = new QWidget;
  auto* grid = new QGridLayout(page);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(5);
  grid->addWidget(note(tr("Count")), 0, 1);
  grid->addWidget(note(tr("Spacing")), 0, 2);
  constexpr std::array kAxes{"X", "Y", "Z"};
  constexpr std::array kCounts{"array_count_x", "array_count_y", "array_count_z"};
  constexpr std::array kSpacings{"array_spacing_x", "array_spacing_y", "array_spacing_z"};
  for (std::size_t i = 0; i < 3; ++i) {
    counts_.at(i) = add_count(kCounts.at(i), 1);
    counts_.at(i)->setAccessibleName(tr("Count along %1").arg(QLatin1String(kAxes.at(i))));
    spacings_.at(i) = add_field(kSpacings.at(i), false);
    const int row = static_cast<int>(i) + 1;
    grid->addWidget(note(QLatin1String(kAxes.at(i))), row, 0);
    grid->addWidget(counts_.at(i), row, 1);
    grid->addWidget(spacings_.at(i), row, 2);
  }
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(2, 2);
  return page;
}

QWidget* ArrayCard::make_circle() {
  auto* page = new QWidget;
  auto* form = new QFormLayout(page);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(5);
  form->setHorizontalSpacing(10);
  around_ = add_count("array_around", 2);
  axis_ = new QComboBox;
  axis_->setObjectName(QStringLiteral("array_axis"));
  axis_->addItems({QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")});
  axis_->setCurrentIndex(2);
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ArrayCard::changed);
  angle_ = add_field("array_angle", true);
  turning_ = new QCheckBox(tr("Copies turn along"));
  turning_->setObjectName(QStringLiteral("array_turning"));
  connect(turning_, &QCheckBox::toggled, this, &ArrayCard::changed);
  form->addRow(note(tr("Count")), around_);
  form->addRow(note(tr("Axis")), axis_);
  constexpr std::array kCentre{"array_centre_x", "array_centre_y", "array_centre_z"};
  const std::array<QString, 3> words{tr("Centre X"), tr("Centre Y"), tr("Centre Z")};
  for (std::size_t i = 0; i < 3; ++i) {
    centre_.at(i) = add_field(kCentre.at(i), false);
    form->addRow(note(words.at(i)), centre_.at(i));
  }
  form->addRow(note(tr("Angle")), angle_);
  form->addRow(turning_);
  return page;
}

void ArrayCard::begin(const QString& objects, const geometric::Aabb& box) {
  const bool was_blocked = blockSignals(true);
  title_->setText(tr("Array of %1").arg(objects));
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    counts_.at(k)->setValue(i == 0 ? 3 : 1);
    spacings_.at(k)->show_quantity(roomy(box.size()[i]));
    const double aside = i == 0 ? 1.5 * roomy(box.size()[i]) : 0.0;
    centre_.at(k)->show_quantity(box.centre()[i] + aside);
  }
  around_->setValue(6);
  angle_->show_quantity(2.0 * std::numbers::pi);
  turning_->setChecked(true);
  blockSignals(was_blocked);
  appear();
  counts_.front()->setFocus();
}

std::vector<geometric::Pose> ArrayCard::motions(const Eigen::Vector3d& p_W) const {
  if (pages_->currentIndex() == 0) {
    planning::LinearArray rows;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      rows.count[i] = counts_.at(k)->value();
      rows.spacing[i] = spacings_.at(k)->quantity();
    }
    return rows.motions();
  }
  planning::CircularArray circle;
  circle.count = around_->value();
  circle.axis = axis_->currentIndex();
  for (int i = 0; i < 3; ++i) {
    circle.centre[i] = centre_.at(static_cast<std::size_t>(i))->quantity();
  }
  circle.angle = angle_->quantity();
  circle.turning = turning_->isChecked();
  return circle.motions(p_W);
}

bool ArrayCard::groups() const { return group_->isChecked(); }

void ArrayCard::show_count(int count, int most) {
  make_->setEnabled(count > 0 && count <= most);
  note_->setText(count > most ? tr("%1 copies are too many: at most %2").arg(count).arg(most)
                 : count == 1 ? tr("1 copy")
                              : tr("%1 copies").arg(count));
}

void ArrayCard::close() {
  hide();
  emit closed();
}

void ArrayCard::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    close();
  } else if (event->key() == Qt::Key_Return && make_->isEnabled()) {
    emit accepted();
  } else {
    FloatingCard::keyPressEvent(event);
  }
}

void ArrayCard::place() {
  for (int i = 0; i < pages_->count(); ++i) {  // only as high as the page that is shown
    const auto vertical =
        i == pages_->currentIndex() ? QSizePolicy::Preferred : QSizePolicy::Ignored;
    pages_->widget(i)->setSizePolicy(QSizePolicy::Preferred, vertical);
  }
  layout()->activate();
  const QSize room = parentWidget()->size() - QSize(2 * kCardMargin, 2 * kCardMargin);
  const QSize size = QSize(scaled(kWidth), layout()->sizeHint().height()).boundedTo(room);
  setGeometry({{parentWidget()->width() - size.width() - kCardMargin, kCardMargin}, size});
}

ArrayTool::ArrayTool(SceneEditor& editor, SceneView& view, QObject* parent)
    : QObject(parent), editor_(editor), view_(view), card_(new ArrayCard(&view)) {
  connect(card_, &ArrayCard::changed, this, &ArrayTool::show_copies);
  connect(card_, &ArrayCard::accepted, this, &ArrayTool::finish);
  connect(card_, &ArrayCard::closed, this, &ArrayTool::end);
  connect(&editor_, &SceneEditor::selection_changed, this, &ArrayTool::end);
}

void ArrayTool::begin() {
  names_ = editor_.selected_objects();
  if (names_.empty()) {
    return;
  }
  card_->begin(SceneEditor::words_for(names_),
               bounds(*editor_.state().scene, editor_.document().configuration(), names_));
  show_copies();
}

void ArrayTool::show_copies() {
  const geometric::Configuration& q = editor_.document().configuration();
  const Eigen::Vector3d p_W = bounds(*editor_.state().scene, q, names_).centre();
  const std::vector<geometric::Pose> motions = card_->motions(p_W);
  const auto count = static_cast<int>(motions.size() * names_.size());
  card_->show_count(count, kMostCopies);
  copies_ = copied(editor_.state(), q, names_,
                   count > kMostCopies ? std::vector<geometric::Pose>{} : motions);
  view_.update_scene(copies_.state);
}

void ArrayTool::finish() {
  planning::ObjectNames all = names_;
  all.insert(all.end(), copies_.names.begin(), copies_.names.end());
  planning::SceneState made = copies_.state;
  if (card_->groups()) {
    const std::string group = planning::unused_group(
        *made.scene, names_.size() == 1 ? names_.front() : tr("array").toStdString());
    made = with_changed_display(made, all, [&](auto& display) { display.group = group; });
  }
  editor_.apply(tr("Array of %1").arg(SceneEditor::words_for(names_)), std::move(made), all);
}

void ArrayTool::end() {
  if (std::exchange(names_, {}).empty()) {
    return;
  }
  card_->hide();
  copies_ = {};
  if (editor_.state().scene) {
    view_.update_scene(editor_.state());
  }
}

}  // namespace handway::gui
