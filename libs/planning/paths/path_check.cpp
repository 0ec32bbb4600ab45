#include "handway/planning/paths/path_check.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/pose_goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

constexpr double kEndTolerance = 1e-3;  // rad or m
constexpr double kNoMotion = 1e-6;      // rad or m

void check_end(const char* which, const Configuration& expected, const Configuration& found,
               PathCheckResult& result) {
  const double off = (expected - found).lpNorm<Eigen::Infinity>();
  if (off > kEndTolerance) {
    result.faults.push_back(
        fmt::format("The path's {} is {:.4g} rad from the scene's.", which, off));
  }
}

// Checks that the path ends at a goal pose, and that joints that do not move the pose's link are at
// the goal.
void check_pose_end(const PlanningProblem& problem, const Configuration& end,
                    PathCheckResult& result) {
  const geometric::Scene& scene = *problem.scene;
  if (const std::string miss = pose_goal_miss(scene, end); !miss.empty()) {
    result.faults.push_back(fmt::format("The path's end {}.", miss));
  }
  Configuration expected = problem.model().nearest_equivalent(end, problem.goal);
  for (const geometric::PoseGoal& goal : scene.goal_poses) {
    const int link = problem.model().find_link(goal.link).value();
    for (const int v : geometric::chain_variables(problem.model(), link)) {
      expected[v] = end[v];
    }
  }
  check_end("end", expected, end, result);
}

// Waypoints that are not configurations of the robot can't be compared.
bool check_shape(const geometric::RobotModel& model, const Path& path, PathCheckResult& result) {
  if (path.empty()) {
    result.faults.emplace_back("The path has no waypoints.");
  }
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    const std::string fault = geometric::configuration_fault(model, path.waypoints[w]);
    if (!fault.empty()) {
      result.faults.push_back(fmt::format("Waypoint {} {}.", w + 1, fault));
    }
  }
  return result.valid();
}

void check_limits(const PlanningProblem& problem, const Path& path, PathCheckResult& result) {
  const geometric::JointIndices& fixed = problem.joints.fixed;
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    for (const geometric::LimitViolation& violation :
         geometric::limit_violations(problem.model(), path.waypoints[w], fixed)) {
      result.faults.push_back(fmt::format("Waypoint {}: {}.", w + 1, to_string(violation)));
    }
  }
}

// Reports, for each joint that the scene's group leaves at the start, the first waypoint that moves
// it.
void check_group(const PlanningProblem& problem, const Path& path, PathCheckResult& result) {
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    const auto moved = std::ranges::find_if(path.waypoints, [&](const Configuration& q) {
      return std::abs(q[v] - path.waypoints.front()[v]) > kNoMotion;
    });
    if (moved != path.waypoints.end() && !std::ranges::binary_search(problem.joints.moving, v)) {
      result.faults.push_back(fmt::format("Waypoint {}: joint {} moves, but is not in the group.",
                                          moved - path.waypoints.begin() + 1,
                                          problem.model().variable(v).name));
    }
  }
}

void check_turns(const geometric::RobotModel& model, const Path& path, PathCheckResult& result) {
  for (std::size_t w = 1; w < path.waypoints.size(); ++w) {
    const std::string jump = turn_fault(model, path.waypoints[w - 1], path.waypoints[w]);
    if (!jump.empty()) {
      result.faults.push_back(fmt::format("After waypoint {}: {}.", w, jump));
    }
  }
}

/// Walks along the path and keeps the worst place.
class Walk {
 public:
  Walk(const PlanningProblem& problem, double resolution, PathCheckResult& result,
       const std::stop_token& stop)
      : stop_(stop),
        checker_(problem.checker->shared_world()),
        rangefinder_(problem.checker->clone()),
        motion_(*problem.motion),
        resolution_(resolution),
        result_(result) {}

  void run(const Path& path) {
    look(path.waypoints.front(), 1);
    for (std::size_t w = 0; w + 1 < path.waypoints.size(); ++w) {
      const Configuration delta = path.waypoints[w + 1] - path.waypoints[w];
      const int steps = std::max(1, static_cast<int>(std::ceil(travel(delta) / resolution_)));
      for (int s = 1; s <= steps; ++s) {
        look(path.waypoints[w] + (static_cast<double>(s) / steps) * delta, w + 1);
      }
    }
    result_.min_clearance = least_;
  }

 private:
  // Largest travel of a point (m), or of a constraint's point or axis (m or rad).
  [[nodiscard]] double travel(const Configuration& delta) const {
    const geometric::CollisionWorld& world = checker_.world();
    double most = motion_.any_point(delta.cwiseAbs());
    for (int c = static_cast<int>(world.pairs().size()); c < world.check_count(); ++c) {
      most = std::max(most, motion_.bound(c, delta.cwiseAbs()));
    }
    return most;
  }

  void look(const Configuration& q, std::size_t stretch) {
    geometric::end_if_stopped(stop_);
    ++result_.configurations;
    const geometric::NamedPair closest = geometric::find_clearance(*rangefinder_, q, least_);
    if (closest.distance < least_) {
      least_ = closest.distance;
      result_.closest_pair = closest.a + " with " + closest.b;
    }
    if (const auto pair = checker_.first_collision(q)) {
      ++result_.collisions;
      least_ = checker_.world().constraint(*pair) ? least_ : 0.0;
      if (result_.collisions == 1) {
        result_.faults.push_back(fault(*pair, stretch));
      }
    }
  }

  // Describes the fault of the configuration in place.
  [[nodiscard]] std::string fault(int pair, std::size_t stretch) const {
    if (const geometric::LinkConstraint* constraint = checker_.world().constraint(pair)) {
      return fmt::format("Constraint {} is violated after waypoint {}: {}.", constraint->name(),
                         stretch, constraint->description(checker_.link_poses()));
    }
    return fmt::format("Collision of {} after waypoint {}.",
                       to_string(named_pair(checker_.world(), pair, 0.0)), stretch);
  }

  const std::stop_token& stop_;
  geometric::FclChecker checker_;  ///< The reference checker, independent of the planner's.
  std::unique_ptr<geometric::CollisionChecker> rangefinder_;  ///< Faster checker, for the
                                                              ///< clearance.
  const geometric::MotionBound& motion_;
  double resolution_;
  PathCheckResult& result_;
  double least_ = kFarClearance;
};

}  // namespace

std::string turn_fault(const geometric::RobotModel& model, const Configuration& from,
                       const Configuration& to) {
  const Configuration nearest = model.nearest_equivalent(from, to);
  for (int v = 0; v < std::min(from.size(), to.size()); ++v) {
    if (nearest[v] != to[v]) {
      return fmt::format(
          "joint {} turns by {:.0f}° at once, although {:.1f}° lead to the same position",
          model.variable(v).name, geometric::degrees(to[v] - from[v]),
          geometric::degrees(nearest[v] - from[v]));
    }
  }
  return "";
}

namespace {

// Finds collisions between samples, however close they are: a motion past something thin.
void certify(const PlanningProblem& problem, const Path& path, const std::stop_token& stop,
             PathCheckResult& result) {
  const auto conflict =
      PathConflictSearch(problem).run(path.waypoints, [&] { return stop.stop_requested(); });
  geometric::end_if_stopped(stop);
  if (conflict) {
    result.faults.push_back(
        fmt::format("{} after waypoint {}.", conflict->text, conflict->waypoint + 1));
  }
}

}  // namespace

PathCheckResult check_path(const PlanningProblem& problem, const Path& path, double resolution,
                           const std::stop_token& stop) {
  PathCheckResult result;
  if (!check_shape(problem.model(), path, result)) {
    return result;
  }
  const Configuration& begin = path.waypoints.front();
  check_end("start", problem.model().nearest_equivalent(begin, problem.start), begin, result);
  const Configuration& end = path.waypoints.back();
  if (problem.has_pose_goals()) {
    check_pose_end(problem, end, result);
  } else if (problem.has_goal) {
    check_end("end", problem.model().nearest_equivalent(end, problem.goal), end, result);
  }
  check_limits(problem, path, result);
  check_turns(problem.model(), path, result);
  check_group(problem, path, result);
  result.warnings = holding_warnings(*problem.scene, path.waypoints);
  Walk(problem, resolution, result, stop).run(path);
  if (result.collisions == 0) {
    certify(problem, path, stop, result);
  }
  return result;
}

PathConflictSearch::PathConflictSearch(const PlanningProblem& problem, double resolution)
    : checker_(problem.checker->clone()), motion_(problem.motion), resolution_(resolution) {}

std::string conflict_text(const geometric::CollisionWorld& world, std::optional<int> pair,
                          double resolution) {
  const geometric::NamedPair two = pair ? geometric::named_pair(world, *pair, 0.0)
                                        : geometric::NamedPair{"A body", "another one"};
  if (pair && two.b.empty()) {
    return "The motion violates constraint " + two.a;
  }
  return resolution > 0.0
             ? fmt::format("{} comes closer than {:g} mm to {}", two.a, 1e3 * resolution, two.b)
             : fmt::format("{} and {} collide", two.a, two.b);
}

std::string PathConflictSearch::conflict_at(const Configuration& q) {
  const std::optional<int> pair = checker_->first_collision(q);
  return pair ? conflict_text(checker_->world(), pair) : std::string();
}

std::optional<PathConflict> PathConflictSearch::run(std::span<const Configuration> waypoints,
                                                    const std::function<bool()>& stop) {
  geometric::ContinuousCollisionChecker edges(*checker_, motion_, resolution_);
  edges.accept_pieces();
  const auto stopped = [&stop] { return stop && stop(); };
  if (stop) {
    edges.stop_when(stop);
  }
  if (!waypoints.empty()) {
    edges.set_ends({make_edge_end(*checker_, waypoints.front(), resolution_),
                    make_edge_end(*checker_, waypoints.back(), resolution_)});
  }
  for (std::size_t w = 0; w < waypoints.size() && !stopped(); ++w) {
    if (const auto pair = checker_->first_collision(waypoints[w])) {
      return PathConflict{w, 0.0, conflict_text(checker_->world(), pair)};
    }
    if (w == 0) {
      continue;
    }
    const geometric::EdgeResult edge = edges.check(waypoints[w - 1], waypoints[w]);
    if (!edge.free && !stopped()) {
      return PathConflict{w - 1, edge.at, conflict_text(checker_->world(), edge.pair, resolution_)};
    }
  }
  return std::nullopt;
}

}  // namespace handway::planning
