#include "handway/planning/timing/time_path.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/timing/jerk_limited.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

void check(const char* what, double value, double above, double most) {
  if (!(value > above && value <= most)) {
    throw geometric::InputError({what, "", fmt::format("{}", value),
                                 fmt::format("a number above {:g}, at most {:g}", above, most),
                                 ""});
  }
}

}  // namespace

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
      problem.arm,
      problem.hand,
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
  blends.shape = options.limit_jerk ? ArcShape::kSmooth : ArcShape::kCircular;
  timed.blends = certified_blends(problem, path, blends);
  if (!timed.blends.path) {
    return timed;
  }
  const BlendedPath& blended = *timed.blends.path;
  const RateLimits limits = timed.motion.limits.at_speed(options.speed);
  const TimeLaw law = align_stops(
      options.limit_jerk ? jerk_limited(blended, limits) : time_optimal(blended, limits),
      options.period);
  timed.motion.waypoint_times = waypoint_times(blended, law);
  timed.motion.trajectory = sample(blended, law, options.period);
  timed.least_duration = least_duration(path, limits);
  PreflightOptions checks;
  checks.limits = timed.motion.limits;
  checks.measured_start = options.measured_start;
  checks.start_tolerance = options.start_tolerance;
  checks.resolution = options.blends.resolution;
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
