#include "handway/geometric/setup/seat.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/robot/group_proposal.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::geometric {
namespace {

using Eigen::Vector3d;

constexpr double kApart = 1e-3;     // m: nearer origins have no direction
constexpr double kAlongAxis = 0.5;  // cosine
constexpr double kNoDepth = 1e-6;   // m: less is rounding

/// A robot in its neutral posture.
struct Posed {
  const RobotModel& model;
  std::vector<Pose> X_BL;

  explicit Posed(const RobotModel& robot)
      : model(robot), X_BL(static_cast<std::size_t>(robot.link_count())) {
    model.forward_kinematics(model.neutral(), X_BL);
  }

  [[nodiscard]] const Pose& operator[](int link) const {
    return X_BL[static_cast<std::size_t>(link)];
  }
  [[nodiscard]] const Pose& operator[](const std::string& link) const {
    return (*this)[model.find_link(link).value()];
  }
};

// Links in order from the root.
std::vector<int> moving_links_above(const RobotModel& model, int link) {
  std::vector<int> moving;
  for (; link > 0; link = model.parent(link)) {
    if (model.joint(link).type != JointType::kFixed) {
      moving.insert(moving.begin(), link);
    }
  }
  return moving;
}

std::size_t count_moving_joints(const RobotModel& model) {
  return static_cast<std::size_t>(
      std::ranges::count_if(model.description().joints,
                            [](const Joint& joint) { return joint.type != JointType::kFixed; }));
}

Vector3d nearest_axis(const Vector3d& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return std::copysign(1.0, direction[largest]) * Vector3d::Unit(largest);
}

// Direction out of the tip: along the last joint's axis away from the arm. If that axis turns the
// tip sideways, as an elbow does, the direction from the joint behind.
Vector3d outward(const Posed& arm, int tip, const std::vector<int>& moving) {
  const auto to_tip = [&](int link) {
    return Vector3d(arm[tip].translation() - arm[link].translation());
  };
  const int last = moving.back();
  Vector3d out = arm[last].linear() * arm.model.joint(last).axis.normalized();
  const auto behind = std::find_if(moving.rbegin(), moving.rend(),
                                   [&](int link) { return to_tip(link).norm() > kApart; });
  if (behind != moving.rend()) {
    const double along = out.dot(to_tip(*behind).normalized());
    out =
        std::abs(along) < kAlongAxis ? to_tip(*behind) : Vector3d(std::copysign(1.0, along) * out);
  }
  return nearest_axis(arm[tip].linear().transpose() * out);
}

// Direction from the root to the fingertips.
Vector3d forward(const Posed& mounted) {
  const GroupProposal groups = propose_groups(mounted.model);
  Vector3d sum = Vector3d::Zero();
  for (const std::string& tip : groups.fingertips) {
    sum += mounted[tip].translation();
  }
  return groups.fingertips.empty() ? Vector3d::UnitZ() : nearest_axis(sum);
}

// Largest extent of collision geometry behind the root; 0 if all of it is in front.
double depth_behind(const Posed& mounted, const Vector3d& ahead) {
  double least = 0.0;
  for (int link = 0; link < mounted.model.link_count(); ++link) {
    for (const Vector3d& vertex : collision_mesh(mounted.model.link(link)).vertices) {
      least = std::min(least, ahead.dot(mounted[link] * vertex));
    }
  }
  return least < -kNoDepth ? -least : 0.0;
}

}  // namespace

std::optional<Seat> find_seat(const RobotModel& carrier, const RobotModel& mounted) {
  const std::optional<int> tip = carrier.find_link(propose_groups(carrier).tip);
  const std::vector<int> moving = moving_links_above(carrier, tip.value_or(0));
  if (moving.empty() || moving.size() != count_moving_joints(carrier)) {
    return std::nullopt;
  }
  const Posed posed(mounted);
  const Vector3d out = outward(Posed(carrier), *tip, moving);
  const Vector3d ahead = forward(posed);
  Seat seat{carrier.link(*tip).name, Pose::Identity()};
  seat.X_LB.linear() = Eigen::Quaterniond::FromTwoVectors(ahead, out).toRotationMatrix();
  seat.X_LB.translation() = depth_behind(posed, ahead) * out;
  return seat;
}

}  // namespace handway::geometric
