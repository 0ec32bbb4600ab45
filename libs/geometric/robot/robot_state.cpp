#include "handway/geometric/robot/robot_state.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/limit_violation.h"

#include <cmath>
#include <string>
#include <utility>

namespace handway::geometric {
namespace {

[[noreturn]] void refuse_value(const RobotModel& model, const std::string& element,
                               const std::string& found, const std::string& expected) {
  throw InputError({"robot " + model.name(), element, found, expected, ""});
}

int variable_named(const RobotModel& model, std::string_view joint_name, double value) {
  const std::optional<int> variable = model.find_variable(joint_name);
  if (!variable) {
    refuse_value(model, "joint " + std::string(joint_name),
                 "no joint of this name that moves on its own", "one of the robot's variables");
  }
  if (!std::isfinite(value)) {
    refuse_value(model, "joint " + std::string(joint_name), std::to_string(value),
                 "a finite value");
  }
  return *variable;
}

}  // namespace

RobotState::RobotState(std::shared_ptr<const RobotModel> model, const Pose& X_WB)
    : model_(std::move(model)),
      X_WB_(X_WB),
      q_(model_->neutral()),
      X_WL_(static_cast<std::size_t>(model_->link_count())) {
  update();
}

void RobotState::set_configuration(const Configuration& q) {
  if (q.size() != model_->variable_count()) {
    refuse_value(*model_, "configuration", std::to_string(q.size()) + " values",
                 std::to_string(model_->variable_count()));
  }
  if (!q.allFinite()) {
    refuse_value(*model_, "configuration", "a value that is not a number", "finite values");
  }
  q_ = q;
  update();
}

void RobotState::set_joint(std::string_view joint_name, double value) {
  q_[variable_named(*model_, joint_name, value)] = value;
  update();
}

void RobotState::set_posture(const NamedPosture& posture) {
  Configuration q = q_;
  for (const auto& [joint_name, value] : posture.values) {
    q[variable_named(*model_, joint_name, value)] = value;
  }
  q_ = q;
  update();
}

double RobotState::joint_value(std::string_view joint_name) const {
  for (int i = 1; i < model_->link_count(); ++i) {
    if (model_->mimic_mapping(i).variable >= 0 && model_->joint(i).name == joint_name) {
      return geometric::joint_value(*model_, i, q_);
    }
  }
  refuse_value(*model_, "joint " + std::string(joint_name), "no moving joint of this name",
               "a joint of the robot");
}

bool RobotState::within_limits() const { return limit_violations(*model_, q_).empty(); }

const Pose& RobotState::link_pose(std::string_view link_name) const {
  const std::optional<int> link = model_->find_link(link_name);
  if (!link) {
    refuse_value(*model_, "link " + std::string(link_name), "no link of this name",
                 "a link of the robot");
  }
  return link_pose(*link);
}

void RobotState::update() {
  model_->forward_kinematics(q_, X_WL_);
  for (Pose& X : X_WL_) {
    X = X_WB_ * X;
  }
}

}  // namespace handway::geometric
