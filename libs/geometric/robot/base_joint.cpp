#include "handway/geometric/robot/base_joint.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace handway::geometric {
namespace {

/// A joint of a chain.
struct Step {
  const char* name;
  JointType type;
  Eigen::Vector3d axis;
  double reach;
};

std::vector<Step> steps_of(const BaseJoint& base, const Eigen::Vector3d& normal) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  constexpr JointType kSlide = JointType::kPrismatic;
  constexpr JointType kTurn = JointType::kRevolute;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  if (base.motion == BaseMotion::kPlanar) {
    const Eigen::Quaterniond to_normal = Eigen::Quaterniond::FromTwoVectors(z, normal);
    return {{"x", kSlide, to_normal * x, kDefaultBaseReach},
            {"y", kSlide, to_normal * y, kDefaultBaseReach},
            {"theta", kTurn, normal.normalized(), kEndless}};
  }
  return {{"trans_x", kSlide, x, kDefaultBaseReach},   {"trans_y", kSlide, y, kDefaultBaseReach},
          {"trans_z", kSlide, z, kDefaultBaseReach},   {"yaw", kTurn, z, kEndless},
          {"pitch", kTurn, y, 0.5 * std::numbers::pi}, {"roll", kTurn, x, kEndless}};
}

std::vector<std::string> names_of(const BaseJoint& base, bool slides_alone) {
  std::vector<std::string> names;
  for (const Step& step : steps_of(base, Eigen::Vector3d::UnitZ())) {
    if (!slides_alone || step.type == JointType::kPrismatic) {
      names.push_back(base.name + '/' + step.name);
    }
  }
  return names;
}

std::string unused_link(const RobotDescription& robot, std::string_view name) {
  std::string unused(name);
  for (int i = 2; std::ranges::count(robot.links, unused, &Link::name) > 0; ++i) {
    unused = std::string(name) + '_' + std::to_string(i);
  }
  return unused;
}

}  // namespace

void add_base_joint(RobotDescription& robot, const BaseJoint& base, const BasePlace& place) {
  const std::vector<Step> steps = steps_of(base, place.normal);
  std::string parent = place.parent;
  for (const Step& step : steps) {
    const bool is_last = &step == &steps.back();
    Joint joint;
    joint.name = base.name + '/' + step.name;
    joint.type = step.type;
    joint.parent = std::exchange(parent, joint.name);
    joint.child = is_last ? place.child : joint.name;
    joint.X_PJ = &step == &steps.front() ? place.X_PJ : Pose::Identity();
    joint.axis = step.axis;
    joint.limits.lower = -step.reach;
    joint.limits.upper = step.reach;
    if (!is_last) {
      robot.links.push_back({joint.child, {}, {}});
    }
    robot.joints.push_back(std::move(joint));
  }
  robot.base_joints.push_back(base);
}

std::vector<std::string> joints_of(const BaseJoint& base) { return names_of(base, false); }

std::vector<std::string> slides_of(const BaseJoint& base) { return names_of(base, true); }

std::vector<double> values_at(const BaseJoint& base, const Pose& X_JC) {
  const Eigen::Vector3d p = X_JC.translation();
  const Eigen::Matrix3d R = X_JC.linear();
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  if (base.motion == BaseMotion::kPlanar) {
    return {p.x(), p.y(), yaw};
  }
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  return {p.x(), p.y(), p.z(), yaw, pitch, std::atan2(R(2, 1), R(2, 2))};
}

void add_moving_root(RobotDescription& robot, const BaseJoint& base, const std::string& root,
                     std::string_view frame) {
  const std::string world = unused_link(robot, frame.empty() ? "world" : frame);
  robot.links.push_back({world, {}, {}});
  add_base_joint(robot, base, {world, root});
  const auto arm = std::ranges::find(robot.groups, "arm", &JointGroup::name);
  if (arm != robot.groups.end()) {
    std::vector<std::string> joints = joints_of(base);
    std::erase_if(joints, [&](const std::string& joint) {
      return std::ranges::count(arm->joints, joint) > 0;
    });
    arm->joints.insert(arm->joints.begin(), joints.begin(), joints.end());
  }
}

}  // namespace handway::geometric
