#include "features/glove/hand_bases.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/sampling/postures/basis_study.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "widgets/forms/arrangement.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QStringList>
#include <QVariant>

#include <algorithm>
#include <map>

namespace handway::gui {

using geometric::ResourceKind;
using geometric::RobotModel;

bool fits(const RobotModel& model, const sampling::PmdBasis& basis) {
  return std::ranges::all_of(basis.joints, [&](const std::string& joint) {
    return geometric::find_variable_of_part(model, joint).has_value();
  });
}

namespace {

using SharedBasis = std::shared_ptr<const sampling::PmdBasis>;

// Returns the basis of the library with this name. Each file is read once: this is called on the
// window's thread whenever a scene is opened.
SharedBasis shipped_basis(const std::string& name) {
  static std::map<std::filesystem::path, SharedBasis> known;
  const std::filesystem::path file =
      geometric::find_resource(ResourceKind::kHandBasis, name, geometric::resource_dir());
  SharedBasis& basis = known[file];
  if (!basis) {
    basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
  }
  return basis;
}

}  // namespace

std::vector<HandBasis> shipped_bases(const RobotModel& model) {
  std::vector<HandBasis> bases;
  for (const std::string& name : geometric::resource_names(ResourceKind::kHandBasis)) {
    if (SharedBasis basis = shipped_basis(name); fits(model, *basis)) {
      bases.push_back({QString::fromStdString(name), name, std::move(basis)});
    }
  }
  return bases;
}

HandBasis open_basis(const std::filesystem::path& file, const RobotModel& model) {
  auto basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
  if (!fits(model, *basis)) {
    throw geometric::InputError({file.string(), "joints", "the hand " + basis->hand,
                                 "joints of " + model.name(),
                                 "Make a basis for this hand from a recording."});
  }
  return {QString::fromStdString(file.stem().string()), std::filesystem::absolute(file),
          std::move(basis)};
}

HandBasis save_basis(const HandBasis& made, const std::filesystem::path& file) {
  sampling::PmdBasis basis = *made.basis;
  if (made.postures.postures.rows() > 0) {
    basis.postures = file.parent_path() / (file.stem().string() + "_postures.csv");
    sampling::write_postures(made.postures, basis.postures);
  }
  sampling::write_pmd_basis(basis, file);
  return {QString::fromStdString(file.stem().string()), std::filesystem::absolute(file),
          std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file))};
}

namespace {

constexpr double kPercentHeld = 100.0;

QString escaped(const HandBasis& basis) { return basis.name.toHtmlEscaped(); }

/// The postures that a basis was made from; none if it does not keep them.
std::optional<sampling::PostureTable> postures_of(const HandBasis& basis) {
  if (basis.postures.postures.rows() > 0) {
    return basis.postures;
  }
  if (basis.basis->postures.empty()) {
    return std::nullopt;
  }
  return sampling::read_postures(basis.basis->postures);
}

/// "92 %, 3.1°": of what variance of the postures the basis holds, and what it misses.
QString held_text(const RobotModel& model, const sampling::PmdBasis& basis,
                  const sampling::PostureTable& postures) {
  const sampling::Reconstruction found = sampling::reconstruct(basis, postures);
  double squares = 0.0;
  for (std::size_t j = 0; j < basis.joints.size(); ++j) {
    const int v = geometric::find_variable_of_part(model, basis.joints[j]).value();
    const double off = found.rms[static_cast<Eigen::Index>(j)] *
                       (model.upper()[v] - model.lower()[v]) / geometric::kDegree;
    squares += off * off;
  }
  return QStringLiteral("%1 %, %2°")
      .arg(kPercentHeld * found.held, 0, 'f', 1)
      .arg(std::sqrt(squares / static_cast<double>(basis.joints.size())), 0, 'f', 1);
}

QString comparison_text(const RobotModel& model, const HandBasis& a, const HandBasis& b) {
  QStringList angles;
  for (const double angle : sampling::angles_between(*a.basis, *b.basis)) {
    angles << QStringLiteral("%1°").arg(angle / geometric::kDegree, 0, 'f', 0);
  }
  QString text =
      QObject::tr("Angles between the subspaces: %1").arg(angles.join(QStringLiteral(", ")));
  text += QStringLiteral(
              "<table cellspacing=0 cellpadding=3><tr><td>%1</td><td>%2</td><td>%3</td>"
              "</tr>")
              .arg(QObject::tr("Variance held, RMS joint error"), escaped(a), escaped(b));
  for (const HandBasis* own : {&a, &b}) {
    const auto postures = postures_of(*own);
    const QString of = QObject::tr("Postures of %1").arg(escaped(*own));
    text += postures ? QStringLiteral("<tr><td>%1</td><td>%2</td><td>%3</td></tr>")
                           .arg(of, held_text(model, *a.basis, *postures),
                                held_text(model, *b.basis, *postures))
                     : QStringLiteral("<tr><td>%1</td><td colspan=2>%2</td></tr>")
                           .arg(of, QObject::tr("none recorded"));
  }
  return text + QStringLiteral("</table>");
}

}  // namespace

BasisComparisonView::BasisComparisonView(QWidget* parent)
    : QWidget(parent),
      other_(named("explorer_compare", new QComboBox)),
      table_(named("basis_comparison", note())) {
  other_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  other_->setMinimumContentsLength(3);
  other_->setToolTip(
      tr("Compare with another basis of this hand: the angles between the subspaces, and the share "
         "of each other's postures that they contain"));
  table_->setWordWrap(true);
  table_->setTextFormat(Qt::RichText);
  auto* label = new QLabel(tr("Compare with"));
  label->setBuddy(other_);
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(8);
  layout->setVerticalSpacing(4);
  layout->addWidget(label, 0, 0);
  layout->addWidget(other_, 0, 1);
  layout->addWidget(table_, 1, 0, 1, 2);
  layout->setColumnStretch(1, 1);
  connect(other_, qOverload<int>(&QComboBox::activated), this, &BasisComparisonView::compare);
  connect(&job_, &LatestJob::failed, table_,
          [this](const QString& message) { table_->setText(message.toHtmlEscaped()); });
  set_bases(nullptr, std::nullopt, {});
}

void BasisComparisonView::set_bases(std::shared_ptr<const RobotModel> model,
                                    std::optional<HandBasis> shown, std::vector<HandBasis> others) {
  const QString chosen = other_->currentText();
  model_ = std::move(model);
  shown_ = std::move(shown);
  others_ = std::move(others);
  const QSignalBlocker quiet(other_);
  other_->clear();
  other_->addItem(tr("nothing"));
  for (const HandBasis& basis : others_) {
    other_->addItem(basis.name);
  }
  other_->setCurrentIndex(std::max(0, other_->findText(chosen)));
  setVisible(shown_ && !others_.empty());
  compare();
}

QString BasisComparisonView::text() const { return table_->text(); }

void BasisComparisonView::compare() {
  job_.cancel();
  const int other = other_->currentIndex() - 1;
  table_->setVisible(other >= 0);
  table_->clear();
  if (!shown_ || other < 0) {
    return;
  }
  job_.run([this, model = model_, a = *shown_,
            b = others_[static_cast<std::size_t>(other)]](const std::stop_token&) {
    return [this, text = comparison_text(*model, a, b)] { table_->setText(text); };
  });
}

}  // namespace handway::gui
