#include "features/postures/joint_panel.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/slider_row.h"

#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>
#include <optional>

namespace handway::gui {
namespace {

using geometric::JointType;

constexpr int kAround = 60;  // px, of a row that is brought into sight
constexpr int kLabelWidth = 128;

SliderRow::Range range_of(const geometric::JointLimits& limits, JointType type) {
  if (type == JointType::kPrismatic) {
    return {limits.lower, limits.upper, 1e3, QStringLiteral(" mm"), 1};
  }
  return {limits.lower, limits.upper, 1.0 / geometric::kDegree, QStringLiteral("°"), 1};
}

// Limits of a joint: what its leader, if it is coupled, lets it reach. Continuous joints are shown
// over one turn.
geometric::JointLimits reach(const geometric::RobotModel& model, int link) {
  const geometric::RobotModel::Drive& drive = model.drive(link);
  const double a = drive.multiplier * model.lower()[drive.variable] + drive.offset;
  const double b = drive.multiplier * model.upper()[drive.variable] + drive.offset;
  geometric::JointLimits limits;
  limits.lower = std::min(a, b);
  limits.upper = std::max(a, b);
  return limits;
}

}  // namespace

JointPanel::JointPanel(QWidget* parent)
    : QWidget(parent), scroll_(new QScrollArea), content_(nullptr), layout_(nullptr) {
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(0, 0, 0, 0);
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  content_ = new QWidget;
  layout_ = new QVBoxLayout(content_);
  layout_->setContentsMargins(12, 10, 12, 10);
  layout_->setSpacing(3);
  scroll_->setWidget(content_);
  outer->addWidget(scroll_);
}

void JointPanel::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                           const JointGroups& groups) {
  model_ = std::move(model);
  rows_.clear();
  while (QLayoutItem* item = layout_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (model_) {
    q_ = model_->neutral();
    add_group(tr("Arm"), groups.arm);
    add_group(tr("Hand"), groups.hand);
    add_group(tr("Other"), groups.other);
  }
  layout_->addStretch();
}

void JointPanel::add_group(const QString& title, const std::vector<int>& variables) {
  if (variables.empty()) {
    return;
  }
  auto* heading = new QLabel(title);
  heading->setProperty("role", "heading");
  layout_->addWidget(heading);
  std::vector<int> links;
  for (int link = 1; link < model_->link_count(); ++link) {
    if (std::ranges::count(variables, model_->drive(link).variable) > 0) {
      links.push_back(link);
    }
  }
  for (const int link : links) {
    const int variable = model_->drive(link).variable;
    SliderRow* row = add_row(link);
    if (model_->variable_link(variable) != link) {
      row->set_read_only();
      row->setToolTip(
          tr("Coupled to %1").arg(QString::fromStdString(model_->variable(variable).name)));
      continue;
    }
    connect(row, &SliderRow::value_edited, this, [this, variable](double value) {
      q_[variable] = value;
      set_configuration(geometric::Configuration(q_));
      emit configuration_edited(q_);
    });
  }
}

SliderRow* JointPanel::add_row(int link) {
  const geometric::Joint& joint = model_->joint(link);
  auto* row =
      new SliderRow(QString::fromStdString(joint.name), range_of(reach(*model_, link), joint.type));
  row->set_label_width(kLabelWidth);
  row->setObjectName(QString::fromStdString(joint.name));
  layout_->addWidget(row);
  rows_.push_back({link, row});
  return row;
}

void JointPanel::show_link(const std::string& name) {
  const std::optional<int> named = model_ ? model_->find_link(name) : std::nullopt;
  if (!named) {
    return;
  }
  const auto row_of = [this](int link) { return std::ranges::find(rows_, link, &Row::link); };
  int link = *named;
  while (link > 0 && row_of(link) == rows_.end()) {
    link = model_->parent(link);
  }
  const auto chosen = row_of(link);
  for (const Row& row : rows_) {
    row.slider->set_chosen(chosen != rows_.end() && row.link == link);
  }
  if (chosen != rows_.end()) {
    scroll_->ensureWidgetVisible(chosen->slider, 0, kAround);
  }
}

void JointPanel::set_configuration(const geometric::Configuration& q) {
  if (!model_) {
    return;
  }
  q_ = q;
  const geometric::Configuration shown =
      model_->nearest_equivalent(geometric::Configuration::Zero(q.size()), q);
  for (const Row& row : rows_) {
    const geometric::RobotModel::Drive& drive = model_->drive(row.link);
    row.slider->set_value(drive.multiplier * shown[drive.variable] + drive.offset);
  }
}

}  // namespace handway::gui
