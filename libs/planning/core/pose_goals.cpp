#include "handway/planning/core/pose_goals.h"

#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/core/motion_validator.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Configuration;
using geometric::NumericIkOptions;
using geometric::NumericInverseKinematics;
using geometric::Pose;
using geometric::PoseGoal;
using geometric::PoseGoalMiss;
using geometric::RobotInstance;
using geometric::Scene;

constexpr int kMostCandidates = 6;          // candidates of one pose
constexpr int kStarts = 80;                 // starts of the iterations for one pose
constexpr int kSpreadStarts = 800;          // more starts, if all of these collide
constexpr double kInside = 0.99;            // share of the tolerance that is used
constexpr double kRounding = 1e-6;          // m and rad
constexpr std::size_t kMostNamedPairs = 3;  // pairs that a message names

PoseGoalMiss miss_at(const Scene& scene, const PoseGoal& goal, const Configuration& q) {
  const RobotInstance& robot = scene.robots.front();
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_BL);
  const auto link = static_cast<std::size_t>(robot.model->find_link(goal.link).value());
  return miss_of(goal, robot.X_WB * X_BL[link]);
}

// Returns the part of a miss beyond the tolerances, one radian counting as 0.3 m.
double excess(const PoseGoal& goal, const PoseGoalMiss& miss) {
  constexpr double kWeight = 0.3;  // m/rad
  const auto beyond = [](const Eigen::Vector3d& by, const Eigen::Vector3d& tolerance) {
    return (by.cwiseAbs() - tolerance).cwiseMax(0.0).norm();
  };
  return beyond(miss.position, goal.position_tolerance) +
         kWeight * beyond(miss.rotation, goal.rotation_tolerance);
}

/// Searches configurations at goal poses, and records the faults of refused ones.
class GoalPoseSearch {
 public:
  GoalPoseSearch(const Scene& scene, const geometric::CollisionChecker& checker,
                 const Configuration& start)
      : scene_(scene),
        robot_(scene.robots.front()),
        checker_(checker.clone()),
        start_(start),
        moving_(geometric::moving_variables(scene)),
        reference_(start) {
    if (scene.goal) {
      reference_(moving_) = (*scene.goal)(moving_);
    }
  }

  PoseGoalSolutions run() {
    for (std::size_t pose = 0; pose < scene_.goal_poses.size(); ++pose) {
      const int refused_before = refused_;
      if (!solve(pose, 0.0) && !solve(pose, kInside) && refused_ > refused_before) {
        spread_ = true;
        solve(pose, 0.0);
        spread_ = false;
      }
    }
    const Configuration from = geometric::normalised(*robot_.model, start_);
    std::ranges::stable_sort(found_.candidates, {}, [&](const GoalCandidate& candidate) {
      return (geometric::normalised(*robot_.model, candidate.q) - from).norm();
    });
    if (!found_.candidates.empty()) {
      found_.nearest = found_.candidates.front().q;
    } else if (colliding_) {
      found_.nearest = *colliding_;
      found_.fault = collision_sentence();
    } else {
      nearest_miss();
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] NumericInverseKinematics kinematics(const PoseGoal& goal,
                                                    double tolerance_share) const {
    NumericIkOptions options;
    options.X_LT = goal.X_LT;
    options.max_restarts = (spread_ ? kSpreadStarts : kStarts) - 1;
    options.stay_near = !spread_;
    const auto is_free = goal.rotation_tolerance.array() >= std::numbers::pi;
    options.position_only = is_free.all();
    options.position_slack = tolerance_share * goal.position_tolerance;
    options.rotation_slack =
        is_free.select(Eigen::Vector3d::Constant(std::numbers::pi),
                       Eigen::Vector3d(tolerance_share * goal.rotation_tolerance));
    return {robot_.model, goal.link, joints_for(goal.link), options};
  }

  [[nodiscard]] bool is_moved(const PoseGoal& goal) const {
    return scene_.group.empty() || !joints_for(goal.link).empty();
  }

  // Names of the moving joints that move the link; an empty list stands for all joints.
  [[nodiscard]] std::vector<std::string> joints_for(const std::string& link) const {
    std::vector<std::string> joints;
    if (scene_.group.empty()) {
      return joints;
    }
    for (const int v : chain_variables(*robot_.model, robot_.model->find_link(link).value())) {
      if (std::ranges::binary_search(moving_, v)) {
        joints.push_back(robot_.model->variable(v).name);
      }
    }
    return joints;
  }

  // Adds configurations that reach the pose, using a share of its tolerances. @returns whether
  // there are any.
  bool solve(std::size_t pose, double tolerance_share) {
    const PoseGoal& goal = scene_.goal_poses[pose];
    if (!is_moved(goal)) {
      return false;
    }
    const std::vector<Configuration> postures =
        kinematics(goal, tolerance_share)
            .find_several(robot_.X_WB.inverse() * goal.X_WG, reference_, kMostCandidates,
                          [&](const Configuration& q) { return accept(q); });
    for (const Configuration& q : postures) {
      found_.candidates.push_back({robot_.model->nearest_equivalent(start_, q), pose});
    }
    return !postures.empty();
  }

  bool accept(const Configuration& q) {
    std::optional<int> pair = checker_->first_collision(q, last_pair_);
    if (!pair && keeps_end_clearance(*checker_, q, kLeastEndClearance)) {
      return true;
    }
    ++refused_;
    colliding_ = colliding_ ? colliding_ : std::optional(q);
    if (pair) {
      last_pair_ = *pair;
      ++refusals_[*pair];
    }
    return false;
  }

  [[nodiscard]] std::string collision_sentence() const {
    std::vector<std::pair<int, int>> pairs;  // count, pair
    for (const auto& [pair, count] : refusals_) {
      pairs.emplace_back(-count, pair);
    }
    std::ranges::sort(pairs);
    std::string text;
    for (std::size_t i = 0; i < std::min(kMostNamedPairs, pairs.size()); ++i) {
      text += fmt::format("{}{} ({} times)", i == 0 ? ": " : ", ",
                          to_string(named_pair(checker_->world(), pairs[i].second, 0.0)),
                          -pairs[i].first);
    }
    if (pairs.size() > kMostNamedPairs) {
      text += fmt::format(" and {} more", pairs.size() - kMostNamedPairs);
    }
    return fmt::format(
        "The goal is in collision: {} can be reached, but all {} configurations found are in "
        "collision{}.",
        poses(), refused_, text.empty() ? " or too close to a body" : text);
  }

  void nearest_miss() {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t pose = 0; pose < scene_.goal_poses.size(); ++pose) {
      const PoseGoal& goal = scene_.goal_poses[pose];
      const Configuration q =
          is_moved(goal)
              ? kinematics(goal, kInside).find(robot_.X_WB.inverse() * goal.X_WG, reference_).q
              : start_;
      if (const double by = excess(goal, miss_at(scene_, goal, q));
          by < least || found_.nearest.size() == 0) {
        least = by;
        found_.nearest = q.allFinite() ? q : start_;
      }
    }
    found_.fault = fmt::format(
        "The goal is out of reach: the nearest configuration that was found "
        "{}.",
        pose_goal_miss(scene_, found_.nearest));
  }

  [[nodiscard]] std::string poses() const {
    return scene_.goal_poses.size() == 1 ? name_of_pose_goal(scene_, 0)
                                         : fmt::format("its {} poses", scene_.goal_poses.size());
  }

  const Scene& scene_;
  const RobotInstance& robot_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  const Configuration& start_;
  std::vector<int> moving_;
  Configuration reference_;
  PoseGoalSolutions found_;
  std::optional<Configuration> colliding_;  ///< The first refused one.
  std::map<int, int> refusals_;             ///< By pair.
  int refused_ = 0;
  int last_pair_ = 0;
  /// Keeps configurations where they are found: sampled near the reference they become similar, and
  /// the robot is in collision in all of them or in none.
  bool spread_ = false;
};

}  // namespace

PoseGoalSolutions solve_pose_goals(const Scene& scene, const geometric::CollisionChecker& checker,
                                   const Configuration& start) {
  return GoalPoseSearch(scene, checker, start).run();
}

std::string pose_goal_miss(const Scene& scene, const Configuration& q) {
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (std::size_t pose = 0; pose < scene.goal_poses.size(); ++pose) {
    const PoseGoal& goal = scene.goal_poses[pose];
    const PoseGoalMiss miss = miss_at(scene, goal, q);
    if (is_within_tolerance(goal, miss, kRounding)) {
      return "";
    }
    // The excess of a pose beyond all numbers is infinite.
    if (const double by = excess(goal, miss); by < least || text.empty()) {
      least = by;
      text =
          fmt::format("misses {} by {}", name_of_pose_goal(scene, pose), describe_miss(goal, miss));
    }
  }
  return text;
}

std::string name_of_pose_goal(const Scene& scene, std::size_t pose) {
  return fmt::format("goal pose {}of link {}",
                     scene.goal_poses.size() == 1 ? "" : fmt::format("{} ", pose + 1),
                     scene.goal_poses[pose].link);
}

}  // namespace handway::planning
