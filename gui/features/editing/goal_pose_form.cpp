#include "features/editing/goal_pose_form.h"

#include "handway/geometric/robot/inverse_kinematics.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/forms/typed_input.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace handway::gui {
namespace {

bool is_free(const geometric::PoseGoal& goal, int axis) {
  return goal.rotation_tolerance[axis] >= std::numbers::pi;
}

QuantityField* tolerance_field(QuantityField::Kind kind, double most, const char* name,
                               const QString& tip) {
  auto* field = new QuantityField(kind, 0.0, most);
  field->setObjectName(QLatin1String(name));
  field->setToolTip(tip);
  return field;
}

}  // namespace

GoalPoseForm::GoalPoseForm(QWidget* parent)
    : QWidget(parent),
      link_(named("goal_link", new QComboBox)),
      object_(named("goal_object", new QComboBox)),
      position_(tolerance_field(QuantityField::Kind::kLength, 1.0, "goal_position_tolerance",
                                tr("How far the tool may be from the pose along each axis"))),
      rotation_(tolerance_field(QuantityField::Kind::kAngle, std::numbers::pi,
                                "goal_rotation_tolerance",
                                tr("How far the tool may be turned about each axis"))),
      fold_(named("goal_tool_fold", new QToolButton)),
      more_(new QWidget),
      tool_(new PoseForm) {
  link_->setToolTip(tr("The link that the goal is for"));
  link_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  object_->setToolTip(tr("If this object or frame is moved, the goal moves with it"));
  object_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* free = new QHBoxLayout;
  free->setSpacing(14);
  for (std::size_t axis = 0; axis < free_.size(); ++axis) {
    const QString name(QChar::fromLatin1("xyz"[axis]));
    free_[axis] = new QCheckBox(name);
    free_[axis]->setObjectName(QStringLiteral("goal_free_%1").arg(name));
    free_[axis]->setAccessibleName(tr("Free about %1").arg(name));
    free_[axis]->setToolTip(tr("The tool may be turned about the pose's %1 axis").arg(name));
    free->addWidget(free_[axis]);
  }
  free->addStretch(1);
  auto* rows = new QFormLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setHorizontalSpacing(10);
  rows->setVerticalSpacing(5);
  rows->setRowWrapPolicy(QFormLayout::WrapLongRows);
  rows->addRow(tr("Link"), link_);
  rows->addRow(tr("Position within"), position_);
  rows->addRow(tr("Rotation within"), rotation_);
  rows->addRow(tr("Free about"), free);
  fold_->setText(tr("More"));
  fold_->setToolTip(
      tr("The object or frame that the goal moves with, and the frame that is brought to the "
         "pose"));
  fold_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  fold_->setAutoRaise(true);
  fold_->setCheckable(true);
  rows->addRow(fold_);
  lay_out(*more_, in_column({in_row({new QLabel(tr("Moves with")), {object_, 1}}, 10),
                             new QLabel(tr("Tool in the link")), tool_},
                            5));
  rows->addRow(more_);
  unfold(false);
  connect_fields();
}

void GoalPoseForm::unfold(bool on) {
  fold_->setChecked(on);
  fold_->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
  more_->setVisible(on);
}

void GoalPoseForm::connect_fields() {
  connect(fold_, &QToolButton::clicked, this, &GoalPoseForm::unfold);
  connect(link_, qOverload<int>(&QComboBox::activated), this, [this] {
    goal_.link = link_->currentText().toStdString();
    emit goal_edited(goal_);
  });
  connect(object_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    goal_.reference = index > 0 ? object_->currentText().toStdString() : std::string();
    emit goal_edited(goal_);
  });
  connect(position_, &QuantityField::quantity_edited, this, [this](double tolerance) {
    goal_.position_tolerance.setConstant(tolerance);
    emit goal_edited(goal_);
  });
  connect(rotation_, &QuantityField::quantity_edited, this, [this](double tolerance) {
    set_rotation(tolerance);
    emit goal_edited(goal_);
  });
  for (int axis = 0; axis < 3; ++axis) {
    connect(free_.at(static_cast<std::size_t>(axis)), &QCheckBox::clicked, this,
            [this, axis](bool free) {
              goal_.rotation_tolerance[axis] = free ? std::numbers::pi : rotation_->quantity();
              emit goal_edited(goal_);
            });
  }
  connect(tool_, &PoseForm::pose_edited, this, [this](const geometric::Pose& X_LT) {
    goal_.X_LT = X_LT;
    goal_.tool.clear();  // a pose of its own
    emit goal_edited(goal_);
  });
}

void GoalPoseForm::set_rotation(double tolerance) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free(goal_, axis)) {
      goal_.rotation_tolerance[axis] = tolerance;
    }
  }
}

void GoalPoseForm::list_links(const geometric::RobotModel& model) {
  std::vector<ShownChoice> choices;
  int current = -1;
  for (int link = 1; link < model.link_count(); ++link) {
    if (!geometric::chain_variables(model, link).empty()) {
      current = model.link(link).name == goal_.link ? static_cast<int>(choices.size()) : current;
      choices.push_back({QString::fromStdString(model.link(link).name)});
    }
  }
  show_choices(*link_, choices, current);
}

void GoalPoseForm::list_objects(const geometric::Scene& scene) {
  std::vector<ShownChoice> choices{{tr("Nothing")}};
  int current = 0;
  for (const std::string& name : geometric::standing_names(scene)) {
    current = name == goal_.reference ? static_cast<int>(choices.size()) : current;
    choices.push_back({QString::fromStdString(name)});
  }
  show_choices(*object_, choices, current);
}

void GoalPoseForm::show_goal(const geometric::Scene& scene, const geometric::PoseGoal& goal) {
  // A form that the user has unfolded stays so; an object, and a tool frame other than the link's,
  // are shown.
  unfold(fold_->isChecked() || !goal.reference.empty() ||
         !goal.X_LT.isApprox(geometric::Pose::Identity()));
  goal_ = goal;
  list_links(*scene.robots.front().model);
  list_objects(scene);
  position_->show_quantity(goal.position_tolerance.maxCoeff());
  double rotation = geometric::PoseGoal().rotation_tolerance.maxCoeff();
  bool any_kept = false;
  for (int axis = 0; axis < 3; ++axis) {
    const bool free = is_free(goal, axis);
    free_.at(static_cast<std::size_t>(axis))->setChecked(free);
    if (!free) {
      rotation = any_kept ? std::max(rotation, goal.rotation_tolerance[axis])
                          : goal.rotation_tolerance[axis];
      any_kept = true;
    }
  }
  rotation_->show_quantity(rotation);
  rotation_->setEnabled(any_kept);
  tool_->show_pose(goal.X_LT);
}

}  // namespace handway::gui
