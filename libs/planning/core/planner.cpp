#include "handway/planning/core/planner.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/planning_context.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace handway::planning {
namespace {

std::string names_of(PlanningContext& context, int pair) {
  const geometric::NamedPair named =
      geometric::named_pair(context.problem().checker->world(), pair, 0.0);
  return named.a + " with " + named.b;
}

// Why the start (0) or the goal (1) can't be an end of a path; empty if it can.
std::string objection(PlanningContext& context, std::size_t end) {
  const geometric::RobotModel& model = context.problem().model();
  const Configuration& q = end == 0 ? context.problem().start : context.problem().goal;
  if (q.size() != model.variable_count()) {
    return fmt::format("has {} values where the robot has {} variables", q.size(),
                       model.variable_count());
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    if (!std::isfinite(q[v])) {
      return fmt::format("has no number for joint {}", model.variable(v).name);
    }
  }
  if (const auto violations = geometric::limit_violations(model, q); !violations.empty()) {
    return "is out of limits: " + to_string(violations.front());
  }
  if (const std::optional<int> pair = context.collision(q)) {
    return "is in collision: " + names_of(context, *pair);
  }
  constexpr double kLeast = 2.0 * geometric::kLeastResolution;
  if (end >= context.ends().size()) {
    return "";  // the other end is no configuration of the robot
  }
  const geometric::EdgeEnd::NearPair* nearest = context.ends()[end].nearest();
  return nearest && nearest->distance < kLeast
             ? fmt::format(
                   "is too close to a collision: {} at {:.6f} mm, at least {:g} mm is needed",
                   names_of(context, nearest->pair), geometric::millimetres(nearest->distance),
                   geometric::millimetres(kLeast))
             : "";
}

// How the search ended, for a planner that has nothing to add.
std::string reason_of(const PlanResult& result, PlanningContext& context) {
  const std::uint64_t samples = context.statistics().samples;
  switch (result.status) {
    case PlanStatus::kSolved:
      return fmt::format("Found a path of {} waypoints after {} samples.",
                         result.path.waypoints.size(), samples);
    case PlanStatus::kTimeLimit:
      return fmt::format("No path found within the time limit of {:g} s, after {} samples.",
                         context.request().time_limit_s, samples);
    case PlanStatus::kCancelled:
      return fmt::format("Cancelled after {:.1f} s and {} samples.", result.time_s, samples);
    case PlanStatus::kStalled:
      return fmt::format(
          "No path found: the search stalled after {} samples, as no configuration is left to "
          "sample.",
          samples);
    default:
      return fmt::format("No path found: all {} samples are spent.", samples);
  }
}

}  // namespace

PlanResult Planner::plan(const PlanningProblem& problem, const PlanRequest& request,
                         std::stop_token stop, Observer* observer) {
  if (request.threads < 1) {
    throw std::invalid_argument("threads must be at least 1");
  }
  if (!(request.resolution_mm > 0.0)) {
    throw std::invalid_argument("resolution must be positive");
  }
  if (capabilities().uses_pmds && !problem.basis) {
    throw geometric::InputError({problem.scene->file.string(), "hand_basis", "nothing",
                                 "a PMD basis for planner " + name(),
                                 "Name one in the scene, or choose another planner"});
  }
  Observer silent;
  PlanningContext context(problem, request, std::move(stop), observer ? *observer : silent);
  PlanResult result;
  if (const std::string start = objection(context, 0); !start.empty()) {
    result.status = PlanStatus::kStartInvalid;
    result.reason = "The start " + start + ".";
  } else if (const std::string goal = objection(context, 1); !goal.empty()) {
    result.status = PlanStatus::kGoalInvalid;
    result.reason = "The goal " + goal + ".";
  } else if (problem.start == problem.goal) {
    result.status = PlanStatus::kSolved;
    result.reason = "The start is the goal: there is nothing to move.";
    result.path.waypoints = {problem.start, problem.goal};
  } else {
    do_plan(context, result);
    result.time_s = context.elapsed_s() - result.smoothing_s;
    if (result.reason.empty()) {
      result.reason = reason_of(result, context);
    }
  }
  result.statistics = context.statistics();
  if (result.solved()) {
    result.certificate = context.certify(result.path);
  }
  return result;
}

}  // namespace handway::planning
