#include "handway/geometric/robot/inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <utility>

namespace handway::geometric {
namespace {

/// Poses whose rotation is less orthonormal than this are refused.
constexpr double kRotationTolerance = 1e-6;

[[noreturn]] void refuse(const RobotModel& model, const std::string& element,
                         const std::string& found, const std::string& expected) {
  throw InputError({"inverse kinematics of " + model.name(), element, found, expected, ""});
}

bool is_rigid(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return X.matrix().allFinite() &&
         (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
             kRotationTolerance &&
         R.determinant() > 0.0;
}

}  // namespace

InverseKinematics::InverseKinematics(std::shared_ptr<const RobotModel> model, int tip_link,
                                     JointIndices variables)
    : model_(std::move(model)), tip_link_(tip_link), variables_(std::move(variables)) {
  if (tip_link_ < 0 || tip_link_ >= model_->link_count()) {
    refuse(*model_, "tip link", "index " + std::to_string(tip_link_), "a link of the robot");
  }
  std::ranges::sort(variables_);
  variables_.erase(std::unique(variables_.begin(), variables_.end()), variables_.end());
  if (variables_.empty()) {
    refuse(*model_, "link " + model_->link(tip_link_).name, "no joint that moves it",
           "at least one variable to solve for");
  }
  if (variables_.front() < 0 || variables_.back() >= model_->variable_count()) {
    refuse(*model_, "variables", "an index out of range", "variables of the robot");
  }
}

IkResult InverseKinematics::solve(const Pose& X_BT, const Configuration& reference) const {
  check(X_BT, reference);
  IkResult result = do_solve(X_BT, reference);
  const Configuration near = reference(variables_);
  std::ranges::stable_sort(result.solutions, {}, [&](const IkSolution& solution) {
    return (solution.q - near).squaredNorm();
  });
  return result;
}

Configuration InverseKinematics::placed(const IkSolution& solution,
                                        const Configuration& reference) const {
  Configuration q = reference;
  q(variables_) = solution.q;
  return q;
}

void InverseKinematics::check(const Pose& X_BT, const Configuration& reference) const {
  if (reference.size() != model_->variable_count()) {
    refuse(*model_, "reference", std::to_string(reference.size()) + " values",
           std::to_string(model_->variable_count()));
  }
  if (!reference.allFinite()) {
    refuse(*model_, "reference", "a value that is not a number", "finite values");
  }
  if (!is_rigid(X_BT)) {
    refuse(*model_, "pose", "no rigid transform", "finite numbers and a rotation");
  }
}

JointIndices chain_variables(const RobotModel& model, int link) {
  JointIndices variables;
  for (int i = link; i > 0; i = model.parent(i)) {
    if (model.mimic_mapping(i).variable >= 0) {
      variables.push_back(model.mimic_mapping(i).variable);
    }
  }
  std::ranges::sort(variables);
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

}  // namespace handway::geometric
