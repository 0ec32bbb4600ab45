#include "handway/device/tracker/tool_follower.h"

#include "handway/geometric/math/units.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace handway::device {
namespace {

constexpr int kMostProjections = 200;
constexpr double kClose = 1e-6;

Eigen::Vector3d in_box(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  return point.cwiseMax(limits.box.min()).cwiseMin(limits.box.max());
}

Eigen::Vector3d in_ball(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from_centre = point - limits.reach_centre;
  const double distance = from_centre.norm();
  return distance <= limits.reach
             ? point
             : Eigen::Vector3d(limits.reach_centre + from_centre * (limits.reach / distance));
}

}  // namespace

void check_workspace(const WorkspaceLimits& limits) {
  if (limits.box.min().hasNaN() || limits.box.max().hasNaN() || limits.box.isEmpty()) {
    throw std::invalid_argument("a workspace's box has to have its lower corner below the upper");
  }
  if (!(limits.reach > 0.0) || !limits.reach_centre.allFinite()) {
    throw std::invalid_argument("a workspace's reach has to be above 0, its centre finite");
  }
  if ((in_box(limits, limits.reach_centre) - limits.reach_centre).norm() >= limits.reach) {
    throw std::invalid_argument("a workspace's box has to be within reach");
  }
}

Eigen::Vector3d nearest_inside(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  // Alternating projections onto two convex sets with a common point converge to both (von Neumann
  // 1933; Bregman 1965).
  Eigen::Vector3d inside = point;
  for (int k = 0; k < kMostProjections; ++k) {
    const Eigen::Vector3d ball = in_ball(limits, inside);
    inside = in_box(limits, ball);
    if ((inside - ball).norm() < kClose) {
      break;
    }
  }
  return inside;
}

namespace {

using geometric::Configuration;
using geometric::IkResult;
using geometric::Pose;

// Tolerance of a reached posture, rad or m.
constexpr double kArrived = 1e-9;
constexpr double kRotationTolerance = 1e-6;

void check(const ToolFollowerSettings& settings) {
  const auto require = [](bool good, const char* what) {
    if (!good) {
      throw std::invalid_argument(what);
    }
  };
  const Eigen::Matrix3d& R = settings.R_BS;
  require(
      R.allFinite() && (R * R.transpose()).isIdentity(kRotationTolerance) && R.determinant() > 0.0,
      "the source's orientation has to be a rotation");
  require(settings.translation_scale >= 0.0 && std::isfinite(settings.translation_scale),
          "a scale can't be below 0");
  require(settings.smoothing >= 0.0, "a time constant can't be below 0");
  require(settings.top_speed > 0.0, "a speed has to be above 0");
  require(settings.largest_branch_step > 0.0, "a step has to be above 0");
  require(settings.longest_gap > 0.0, "a gap has to be above 0");
  check_workspace(settings.workspace);
}

}  // namespace

std::vector<geometric::BoundParameter> parameters_of(ToolFollowerSettings& settings) {
  constexpr double kSlowest = geometric::radians(1.0);
  constexpr double kFastest = geometric::radians(360.0);
  return {{"scale", "Scale", "", "Motion of the tool per motion of the wrist",
           &settings.translation_scale, 0.05, 10.0},
          {"turn", "Turn with the wrist", "", "Turn the tool with the wrist", &settings.rotate},
          geometric::in_thousandths({"smoothing_ms", "Smoothing", "ms",
                                     "Time constant of the low-pass filter that reduces tremor",
                                     &settings.smoothing, 0.0, 2000.0}),
          {"top_speed", "Top speed", "rad/s", "Velocity limit of each joint", &settings.top_speed,
           kSlowest, kFastest}};
}

ToolFollower::ToolFollower(std::shared_ptr<const geometric::InverseKinematics> ik, Configuration q,
                           const ToolFollowerSettings& settings)
    : ik_(std::move(ik)), settings_(settings), q_(std::move(q)), goal_(q_) {
  check(settings_);
  if (q_.size() != ik_->model().variable_count() || !q_.allFinite()) {
    throw std::invalid_argument(
        "a configuration has a finite value for each of the robot's "
        "variables");
  }
  const std::vector<int>& variables = ik_->variables();
  top_speeds_.resize(static_cast<Eigen::Index>(variables.size()));
  std::ranges::transform(variables, top_speeds_.begin(), [&](int variable) {
    return std::min(settings_.top_speed, ik_->model().variable(variable).limits.velocity);
  });
}

void ToolFollower::disengage() {
  engaged_ = false;
  grip_.reset();
}

Pose ToolFollower::tool_pose() const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(ik_->model().link_count()));
  ik_->model().forward_kinematics(q_, X_BL);
  return X_BL[static_cast<std::size_t>(ik_->tip_link())];
}

Pose ToolFollower::wanted_pose(const Pose& X_ST) const {
  const Eigen::Matrix3d& R_BS = settings_.R_BS;
  Pose X_BF = grip_->X_BF;
  X_BF.translation() +=
      settings_.translation_scale * R_BS * (X_ST.translation() - grip_->X_ST.translation());
  if (settings_.rotate) {
    const Eigen::Matrix3d turn = X_ST.linear() * grip_->X_ST.linear().transpose();
    X_BF.linear() = R_BS * turn * R_BS.transpose() * grip_->X_BF.linear();
  }
  return X_BF;
}

void ToolFollower::smooth(const Pose& wanted, double dt) {
  const double share = settings_.smoothing > 0.0 ? 1.0 - std::exp(-dt / settings_.smoothing) : 1.0;
  const Eigen::Quaterniond now(X_BF_.linear());
  X_BF_.translation() += share * (wanted.translation() - X_BF_.translation());
  X_BF_.linear() =
      now.slerp(share, Eigen::Quaterniond(wanted.linear())).normalized().toRotationMatrix();
}

FollowStep ToolFollower::update(const TrackerSample& sample) {
  const double dt = std::max(sample.time - last_time_, 0.0);
  last_time_ = sample.time;
  FollowStep step;
  if (engaged_ && grip_ && dt > settings_.longest_gap) {
    disengage();
    step.reason = "the tracker was silent for too long; close the clutch again";
  }
  if (!engaged_) {
    step.q = q_;
    step.X_BF = tool_pose();
    return step;
  }
  if (!grip_) {
    X_BF_ = tool_pose();
    grip_ = {sample.X_ST, X_BF_};
    goal_ = q_;
  }
  Pose wanted = wanted_pose(sample.X_ST);
  const Eigen::Vector3d inside = nearest_inside(settings_.workspace, wanted.translation());
  step.at_workspace_edge = inside != wanted.translation();
  wanted.translation() = inside;
  smooth(wanted, dt);
  step.X_BF = X_BF_;
  follow(dt, step);
  step.q = q_;
  return step;
}

// Moves on to the smoothed pose, if the inverse kinematics has a solution.
void ToolFollower::follow(double dt, FollowStep& step) {
  const IkResult found = ik_->solve(X_BF_, goal_);
  if (found.solutions.empty()) {
    step.state = FollowState::kOutOfReach;
    step.reason = found.reason;
    return;
  }
  const std::vector<int>& variables = ik_->variables();
  const Eigen::VectorXd& next = found.solutions.front().q;
  const Eigen::VectorXd last = goal_(variables);
  if ((next - last).lpNorm<Eigen::Infinity>() > settings_.largest_branch_step) {
    step.state = FollowState::kBranchEnd;
    step.reason = "only a posture far from the present one reaches there";
    return;
  }
  goal_(variables) = next;
  const Eigen::VectorXd here = q_(variables);
  const Eigen::VectorXd left = next - here;
  // Moves all joints by the same share, so that none has to wait for another.
  const double share = std::min(
      1.0, (top_speeds_ * dt).cwiseQuotient(left.cwiseAbs().cwiseMax(kArrived)).minCoeff());
  q_(variables) = here + share * left;
  const bool arrived = (1.0 - share) * left.lpNorm<Eigen::Infinity>() <= kArrived;
  step.state = arrived ? FollowState::kFollowing : FollowState::kSlowed;
}

}  // namespace handway::device
