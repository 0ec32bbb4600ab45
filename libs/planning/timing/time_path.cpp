#include "handway/planning/timing/time_path.h"

#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/timing/time_parameterization.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

namespace handway::planning {
namespace {

void check_start(const geometric::RobotModel& model, const TrajectoryPoint& first,
                 const Configuration& measured, double tolerance, PreflightReport& report) {
  if (measured.size() != first.position.size()) {
    report.faults.push_back({"", first.time, static_cast<double>(measured.size()),
                             fmt::format("The robot reports {} joints, the trajectory has {}.",
                                         measured.size(), first.position.size())});
    return;
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    const double off = first.position[v] - measured[v];
    if (!(std::abs(off) <= tolerance)) {
      const std::string& joint = model.variable(v).name;
      report.faults.push_back(
          {joint, first.time, measured[v],
           fmt::format(
               "Joint {} is at {:.6f}, {:.6f} away from the start of the trajectory ({:.6f}).",
               joint, measured[v], std::abs(off), first.position[v])});
    }
  }
}

LimitShare largest_share(const geometric::RobotModel& model, const Trajectory& trajectory,
                         const Eigen::VectorXd& limits,
                         const Eigen::VectorXd TrajectoryPoint::*rate) {
  LimitShare largest;
  for (const TrajectoryPoint& point : trajectory.points) {
    for (int v = 0; v < model.variable_count(); ++v) {
      const double share = std::abs((point.*rate)[v]) / limits[v];
      if (share > largest.share) {
        largest = {model.variable(v).name, point.time, share};
      }
    }
  }
  return largest;
}

/// @param options configuration of the robot (of size 0: the trajectory's start), and the
/// resolution of blends.
void check_collisions(const PlanningProblem& problem, const Trajectory& trajectory,
                      const TimingOptions& options, PreflightReport& report) {
  const Configuration& measured = options.measured_start;
  const auto stopped = [&] { return options.stop.stop_requested(); };
  std::vector<Configuration> way;
  std::ranges::transform(trajectory.points, std::back_inserter(way), &TrajectoryPoint::position);
  std::size_t last = way.size() - 1;  // that is reached
  const auto end_at = [&](std::size_t point, const PathConflict& conflict) {
    last = point;
    const double time = trajectory.points[point].time;
    report.faults.push_back({"", time, 0.0, fmt::format("{} at {:.4f} s.", conflict.text, time)});
  };
  PathConflictSearch search(problem, options.blends.resolution);
  std::optional<PathConflict> conflict;
  if (measured.size() == way.front().size()) {
    conflict = search.run(std::array{measured, way.front()}, stopped);
  }
  if (conflict) {
    end_at(0, *conflict);
  } else if ((conflict = search.run(way, stopped))) {
    end_at(conflict->waypoint + (conflict->share > 0.0 ? 1 : 0), *conflict);
  }
  const auto checker = problem.checker->clone();
  double least = kFarClearance;
  for (std::size_t i = 0; i <= last; ++i) {
    geometric::end_if_stopped(options.stop);
    const geometric::NamedPair closest = geometric::find_clearance(*checker, way[i], least);
    if (closest.distance < least) {
      least = closest.distance;
      report.closest_pair = closest.a + " with " + closest.b;
      report.min_clearance_time = trajectory.points[i].time;
    }
  }
  report.min_clearance = least;
}

constexpr double kErrorDecay = 0.05;  // s, time constant of the error after a joint has moved
constexpr double kLookStep = 1e-4;    // m, that a point of the robot moves between two looks

/// Compares the clearance along the trajectory with following errors and the margin.
void check_safety(const PlanningProblem& problem, const Trajectory& trajectory,
                  const TimingOptions& options, PreflightReport& report) {
  const geometric::RobotModel& model = problem.model();
  report.assumed_following_error = options.safety.following_error.size() == 0;
  const Eigen::VectorXd at_limit = report.assumed_following_error ? assumed_following_error(model)
                                                                  : options.safety.following_error;
  SafetyClearance clearance(problem, options.safety.margin);
  Eigen::VectorXd share = Eigen::VectorXd::Zero(model.variable_count());
  const TrajectoryPoint* looked = nullptr;
  double before = trajectory.points.front().time;
  for (const TrajectoryPoint& point : trajectory.points) {
    geometric::end_if_stopped(options.stop);
    const Eigen::VectorXd now =
        point.velocity.cwiseAbs().cwiseQuotient(options.limits.velocity).cwiseMin(1.0);
    share = (std::exp((before - point.time) / kErrorDecay) * share).cwiseMax(now);
    before = point.time;
    const bool is_last = &point == &trajectory.points.back();
    if (!looked || is_last ||
        problem.motion->any_point((point.position - looked->position).cwiseAbs()) > kLookStep) {
      looked = &point;
      const Eigen::VectorXd error = (share.cwiseProduct(at_limit)).array() + kErrorAtRest;
      clearance.look(point.position, error, point.time);
    }
  }
  report.shortfall = clearance.worst();
}

nlohmann::ordered_json to_object(const ClearanceShortfall& shortfall, const std::string& advice) {
  return {{"a", shortfall.a},
          {"b", shortfall.b},
          {"time_s", shortfall.place},
          {"clearance_mm", geometric::millimetres(shortfall.clearance)},
          {"needed_mm", geometric::millimetres(shortfall.needed())},
          {"following_mm", geometric::millimetres(shortfall.following)},
          {"margin_mm", geometric::millimetres(shortfall.margin)},
          {"following_error", shortfall.following_error},
          {"advice", advice}};
}

nlohmann::ordered_json to_object(const LimitShare& share) {
  return {{"joint", share.joint}, {"time_s", share.time}, {"share", share.share}};
}

/// Returns the hand's joints with those that hold an object and are not planned: devices hold them,
/// too.
std::vector<int> with_holding(const PlanningProblem& problem) {
  std::vector<int> hand = problem.joints.hand;
  for (const int v : problem.joints.holding) {
    if (std::ranges::count(hand, v) + std::ranges::count(problem.joints.arm, v) == 0) {
      hand.push_back(v);
    }
  }
  return hand;
}

void check(const char* what, double value, double above, double most) {
  if (!(value > above && value <= most)) {
    throw geometric::InputError({what, "", fmt::format("{}", value),
                                 fmt::format("a number above {:g}, at most {:g}", above, most),
                                 ""});
  }
}

}  // namespace

const MotionStage* stage_at(const Motion& motion, double time) {
  constexpr double kRounding = 1e-9;  // s
  const MotionStage* at = motion.stages.empty() ? nullptr : &motion.stages.front();
  for (const MotionStage& stage : motion.stages) {
    if (motion.waypoint_times[stage.first] < time - kRounding) {
      at = &stage;
    }
  }
  return at;
}

std::vector<geometric::OutputStep> outputs_of(const Motion& motion) {
  std::vector<geometric::OutputStep> outputs;
  for (const MotionStage& stage : motion.stages) {
    const bool is_new =
        stage.output && std::ranges::none_of(outputs, [&](const geometric::OutputStep& other) {
          return other.name == stage.output->name && other.value == stage.output->value;
        });
    if (is_new) {
      outputs.push_back(*stage.output);
    }
  }
  return outputs;
}

PreflightReport preflight(const PlanningProblem& problem, const Trajectory& trajectory,
                          const TimingOptions& options) {
  PreflightReport report;
  report.points = trajectory.points.size();
  report.duration = trajectory.duration();
  report.assumed = options.limits.assumed;
  report.faults =
      check_trajectory(problem.model(), trajectory, options.limits, problem.joints.fixed);
  if (!report.cleared()) {
    return report;
  }
  report.velocity = largest_share(problem.model(), trajectory, options.limits.velocity,
                                  &TrajectoryPoint::velocity);
  report.acceleration = largest_share(problem.model(), trajectory, options.limits.acceleration,
                                      &TrajectoryPoint::acceleration);
  if (options.measured_start.size() > 0) {
    check_start(problem.model(), trajectory.points.front(), options.measured_start,
                options.start_tolerance, report);
  }
  check_collisions(problem, trajectory, options, report);
  std::vector<Configuration> positions;
  std::ranges::transform(trajectory.points, std::back_inserter(positions),
                         &TrajectoryPoint::position);
  report.warnings = holding_warnings(*problem.scene, positions);
  if (report.cleared()) {
    check_safety(problem, trajectory, options, report);
  }
  return report;
}

bool PreflightReport::is_under_way() const {
  constexpr double kAtEnd = 0.01;  // s
  return shortfall->place >= kAtEnd && shortfall->place <= duration - kAtEnd;
}

std::string PreflightReport::advice() const {
  if (!is_under_way()) {
    return fmt::format("The {} itself has too little clearance: move it, or the object.",
                       shortfall->place < 0.5 * duration ? "start" : "goal");
  }
  return fmt::format("Plan again with a margin of {0:g} mm (plan --margin {0:g}), or run slower.",
                     geometric::millimetres(shortfall->suggested_margin()));
}

std::string to_text(const PreflightReport& report) {
  std::string text;
  for (const TrajectoryFault& fault : report.faults) {
    text += fault.text + "\n";
  }
  for (const std::string& warning : report.warnings) {
    text += "warning: " + warning + "\n";
  }
  text += fmt::format("{}: {} points, {:.3f} s\n",
                      report.is_tight()  ? "cleared, but too close"
                      : report.cleared() ? "cleared"
                                         : "NOT CLEARED",
                      report.points, report.duration);
  if (report.is_tight()) {
    text += fmt::format(
        "warning: at {:.3f} s: {}{}. {}\n", report.shortfall->place, to_string(*report.shortfall),
        report.assumed_following_error ? "; no following error was measured" : "", report.advice());
  }
  for (const auto& [what, share] :
       {std::pair("velocity", report.velocity), std::pair("acceleration", report.acceleration)}) {
    if (share.share > 0.0) {
      text += fmt::format("largest {}: {:.1f} % of the limit, joint {} at {:.3f} s\n", what,
                          100.0 * share.share, share.joint, share.time);
    }
  }
  if (!report.closest_pair.empty()) {
    text += fmt::format("smallest clearance: {:.3f} mm at {:.3f} s, {}\n",
                        geometric::millimetres(report.min_clearance), report.min_clearance_time,
                        report.closest_pair);
  }
  for (const std::string& line : assumption_lines(report.assumed)) {
    text += line + "\n";
  }
  return text;
}

std::string to_json(const PreflightReport& report) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const TrajectoryFault& fault : report.faults) {
    faults.push_back({{"joint", fault.joint},
                      {"time_s", fault.time},
                      {"value", fault.value},
                      {"text", fault.text}});
  }
  nlohmann::ordered_json assumed = nlohmann::ordered_json::array();
  for (const AssumedLimit& one : report.assumed) {
    assumed.push_back({{"joint", one.joint}, {"limit", rate_name(one.rate)}, {"value", one.value}});
  }
  const nlohmann::ordered_json object = {
      {"cleared", report.cleared()},
      {"verdict", report.is_tight()  ? "tight"
                  : report.cleared() ? "cleared"
                                     : "not cleared"},
      {"faults", faults},
      {"points", report.points},
      {"duration_s", report.duration},
      {"velocity", to_object(report.velocity)},
      {"acceleration", to_object(report.acceleration)},
      {"min_clearance_mm", geometric::millimetres(report.min_clearance)},
      {"min_clearance_time_s", report.min_clearance_time},
      {"closest_pair", report.closest_pair},
      {"assumed_limits", assumed},
      {"shortfall", report.is_tight() ? to_object(*report.shortfall, report.advice())
                                      : nlohmann::ordered_json()},
      {"assumed_following_error", report.assumed_following_error}};
  return object.dump(2) + "\n";
}

TimedPath time_path(const PlanningProblem& problem, const Path& path, const std::string& name,
                    const TimingOptions& options) {
  check("speed", options.speed, 0.0, 1.0);
  check("period", options.period, 0.0, 1.0);
  check("clearance of arcs", options.blends.arc_clearance, 0.0, 1.0);
  if (!(options.blends.deviation >= 0.0 && options.blends.deviation <= 10.0)) {
    throw geometric::InputError(
        {"deviation of arcs", "", fmt::format("{}", options.blends.deviation), "0 to 10", ""});
  }
  TimedPath timed;
  timed.motion = {
      name,
      problem.scene->robots.front().model,
      problem.joints.arm,
      with_holding(problem),
      options.limits.velocity.size() > 0 ? options.limits : rate_limits(problem.model()),
      options.speed,
      path,
      {},
      {}};
  if (!options.limit_jerk) {
    timed.motion.limits = timed.motion.limits.without_jerk();
  }
  timed.preflight.assumed = timed.motion.limits.assumed;
  BlendOptions blends = options.blends;
  blends.stop = options.stop;
  blends.shape = options.limit_jerk ? ArcShape::kSmooth : ArcShape::kCircular;
  timed.blends = certified_blends(problem, path, blends);
  if (!timed.blends.path) {
    return timed;
  }
  const BlendedPath& blended = *timed.blends.path;
  const JointKinematicLimits limits = timed.motion.limits.at_speed(options.speed);
  const TimeParameterization law =
      align_stops(options.limit_jerk ? jerk_limited(blended, limits, options.stop)
                                     : time_optimal(blended, limits),
                  options.period);
  timed.motion.waypoint_times = waypoint_times(blended, law);
  timed.motion.trajectory = sample(blended, law, options.period);
  timed.least_duration = least_duration(path, limits);
  TimingOptions checks = options;
  checks.limits = timed.motion.limits;
  timed.preflight = preflight(problem, timed.motion.trajectory, checks);
  return timed;
}

std::string motion_name(std::string text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::ranges::replace_if(
      text, [&](char c) { return !is_letter(c) && !(c >= '0' && c <= '9'); }, '_');
  return text.empty() || !is_letter(text.front()) ? "path_" + text : text;
}

}  // namespace handway::planning
