#include "grasping_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::HandStructure;
using geometric::JointSelection;
using geometric::Pose;

// Finds the arm and the hand with this palm.
GraspingHand::ArmAndHand find_hand(const PlanningProblem& problem, int palm) {
  GraspingHand::ArmAndHand found{problem.joints.arm, problem.joints.hand, problem.hand};
  if (found.structure.palm == palm) {
    return found;
  }
  const geometric::RobotModel& model = problem.model();
  const JointSelection all = JointSelection::of_groups(model);
  for (const geometric::Limb& limb : limbs(model, all)) {
    const HandStructure structure = HandStructure::of(model, limb.arm, limb.hand);
    if (!limb.hand.empty() && structure.palm == palm) {
      return {all.arm, limb.hand, structure};
    }
  }
  return found;
}

constexpr double kFullTurn = 2.0 * std::numbers::pi;

double range_of(const geometric::Joint& joint) {
  return joint.is_continuous() ? kFullTurn : joint.limits.upper - joint.limits.lower;
}

}  // namespace

GraspingHand::GraspingHand(const PlanningProblem& problem, int palm)
    : GraspingHand(problem, palm, find_hand(problem, palm)) {}

GraspingHand::GraspingHand(const PlanningProblem& problem, int palm, const ArmAndHand& found)
    : model_(problem.scene->robots.front().model),
      X_WB_(problem.scene->robots.front().X_WB),
      arm_(found.arm),
      hand_(found.hand),
      ik_(model_, palm, arm_) {
  const geometric::JointIndices chain = geometric::chain_variables(*model_, palm);
  std::erase_if(arm_, [&](int v) { return std::ranges::count(chain, v) == 0; });
  links_.push_back(model_->link(palm).name);
  for (const geometric::HandFinger& finger : found.structure.fingers) {
    tips_.push_back(finger.tip);
    for (const int link : finger.links) {
      links_.push_back(model_->link(link).name);
    }
  }
}

std::string GraspingHand::palm_name() const { return model_->link(ik_.palm()).name; }

std::vector<std::string> GraspingHand::arm_names() const {
  std::vector<std::string> names;
  for (const int v : arm_) {
    names.push_back(model_->variable(v).name);
  }
  return names;
}

Pose GraspingHand::palm_pose(const Configuration& q) const { return X_WB_ * ik_.pose(q); }

Configuration GraspingHand::with_hand(const Configuration& q, const Configuration& posture) const {
  Configuration result = q;
  for (const int v : hand_) {
    result[v] = posture[v];
  }
  return result;
}

std::vector<Configuration> GraspingHand::reach(const Configuration& q, const Pose& X_WP) const {
  return ik_.all(q, X_WB_.inverse() * X_WP);
}

PalmLine GraspingHand::line(const Configuration& q, const Vector3d& shift_W) const {
  return palm_line(*model_, ik_, arm_, q, X_WB_.linear().transpose() * shift_W);
}

Configuration GraspingHand::opened(const Configuration& q, const Pregrasp& grasp,
                                   double share) const {
  double most = 0.0;
  for (const int v : hand_) {
    most = std::max(most, std::abs(grasp.squeezed[v] - grasp.q[v]) / range_of(model_->variable(v)));
  }
  Configuration open = q;
  for (const int v : hand_) {
    open[v] -= most > 0.0 ? share / most * (grasp.squeezed[v] - grasp.q[v]) : 0.0;
  }
  return model_->clamped(std::move(open));
}

std::vector<Vector3d> GraspingHand::directions(const Configuration& q,
                                               const Vector3d& object_W) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model_->link_count()));
  model_->forward_kinematics(q, X_BL);
  const Vector3d palm = palm_pose(q).translation();
  Vector3d tips = Vector3d::Zero();
  for (const int tip : tips_) {
    tips += (X_WB_ * X_BL[static_cast<std::size_t>(tip)]).translation() /
            static_cast<double>(tips_.size());
  }
  std::vector<Vector3d> found;
  const std::vector<Vector3d> wanted{palm - object_W, palm - tips, Vector3d::UnitZ()};
  for (const Vector3d& direction : wanted) {
    constexpr double kLeast = 1e-3;  // m
    if (direction.norm() > kLeast) {
      found.push_back(direction.normalized());
    }
  }
  return found;
}

GraspingHand::WayOut GraspingHand::way_out(const TaskWorld& world, const Pregrasp& grasp,
                                           const Configuration& q, const Vector3d& object_W,
                                           double length, bool inwards,
                                           const std::stop_token& stop) const {
  WayOut first;
  for (const double share : {0.0, 0.1, 0.2, 0.4, 0.7}) {
    const Configuration open = opened(q, grasp, share);
    for (const Vector3d& direction : directions(q, object_W)) {
      PalmLine line = this->line(open, length * direction);
      std::optional<std::string> fault;
      if (line.fault.empty()) {
        if (share > 0.0) {
          line.path.waypoints.insert(line.path.waypoints.begin(), q);
        }
        if (inwards) {
          std::ranges::reverse(line.path.waypoints);
        }
        fault = world.conflict(line.path.waypoints, stop);
      } else {
        fault = line.fault;
      }
      if (!fault) {
        return {std::move(line.path), line.deviation, {}, {}};
      }
      if (first.fault.empty()) {
        first.fault = *fault;
        first.shown = line.path.empty() ? open
                      : inwards         ? line.path.waypoints.front()
                                        : line.path.waypoints.back();
      }
    }
  }
  return first;
}

}  // namespace handway::planning
