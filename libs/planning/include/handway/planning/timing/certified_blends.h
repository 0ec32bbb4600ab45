#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/blended_path.h"

#include <optional>
#include <string>

namespace handway::planning {

struct BlendOptions {
  /// Farthest that an arc may pass from its waypoint (rad or m, Euclidean over the joints);
  /// 0: the motion stops at every waypoint.
  double deviation = 0.05;
  ArcShape shape = ArcShape::kCircular;
  /// An arc keeps at least this from everything (m) …
  double arc_clearance = 1e-3;
  /// … and the straight parts this: what paths are certified to.
  double resolution = 5e-5;
};

/// A blended path that is free of collision all along, or why there is none.
struct BlendResult {
  std::optional<BlendedPath> path;
  std::string fault;  ///< A sentence; empty if there is a path.
  int arcs = 0;
  int reduced = 0;  ///< Arcs that had to be smaller than asked, to keep their clearance.
  int stops = 0;    ///< Corners where the motion has to stop.
  double largest_deviation = 0.0;  ///< rad or m
};

/// Rounds the corners of a path without leaving free space. Every edge is checked again,
/// then every arc, by conservative advancement: as far from a checked configuration as the
/// joints can't have spent its clearance. The deviation of an arc that is not free is
/// halved, until it is, or until there is no arc and the motion stops at the waypoint.
/// @throws InputError if the path has no waypoints, or one that is no configuration of the robot
/// within its limits.
[[nodiscard]] HANDWAY_PLANNING_EXPORT BlendResult certified_blends(
    const PlanningProblem& problem, const Path& path, const BlendOptions& options = {});

}  // namespace handway::planning
