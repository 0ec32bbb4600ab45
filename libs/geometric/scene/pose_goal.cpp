#include "handway/geometric/scene/pose_goal.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <numbers>

namespace handway::geometric {

PoseGoalMiss miss_of(const PoseGoal& goal, const Pose& X_WL) {
  const Pose X_GT = goal.X_WG.inverse() * X_WL * goal.X_LT;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_GT.linear()));
  return {X_GT.translation(), turn.angle() * turn.axis()};
}

bool is_within_tolerance(const PoseGoal& goal, const PoseGoalMiss& miss, double slack) {
  const auto keeps = [slack](const Eigen::Vector3d& by, const Eigen::Vector3d& tolerance) {
    return (by.array().abs() <= tolerance.array() + slack).all();
  };
  // No rotation vector is longer than half a turn, up to rounding.
  const Eigen::Vector3d rotation =
      (goal.rotation_tolerance.array() >= std::numbers::pi).select(0.0, miss.rotation);
  return keeps(miss.position, goal.position_tolerance) && keeps(rotation, goal.rotation_tolerance);
}

std::string describe_miss(const PoseGoal& goal, const PoseGoalMiss& miss) {
  std::string text = fmt::format("{:.4g} mm", millimetres(miss.position.norm()));
  if ((goal.rotation_tolerance.array() < std::numbers::pi).any()) {
    text += fmt::format(" and {:.4g} degrees", degrees(miss.rotation.norm()));
  }
  return text;
}

}  // namespace handway::geometric
