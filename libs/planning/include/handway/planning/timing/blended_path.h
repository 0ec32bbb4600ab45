#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// Shape of rounded corners.
enum class ArcShape {
  kCircular,  ///< Constant curvature, which jumps at both ends: the fastest arc.
  kSmooth,    ///< Curvature rises from 0 and falls to it: allows jerk limits.
};

/// A part of a BlendedPath: straight, or an arc in configuration space.
/// At parameter s from its beginning (arc length, but for smooth arcs) the joints are at
///   straight      origin + s t
///   circular arc  origin + r sin(s/r) t + r (1 - cos(s/r)) n
///   smooth arc    origin + s t + l (x³ - x⁴/2) (u - t),  x = s / l, l the length
/// where u is the direction in which it ends: of a smooth arc dq/ds turns from t to u by
/// t + (3 x² - 2 x³) (u - t), and is shorter than 1 between.
struct HANDWAY_PLANNING_EXPORT PathPiece {
  double begin = 0.0;  ///< Arc length of the path before it.
  double length = 0.0;
  double radius = 0.0;               ///< r; 0: straight; for a smooth arc length by angle.
  geometric::Configuration origin;   ///< Start of the piece.
  geometric::Configuration tangent;  ///< t, of length 1: the direction at its start.
  geometric::Configuration normal;   ///< n, of length 1, normal to t; zeros if straight.
  geometric::Configuration turn;     ///< u - t of a smooth arc; else of size 0.
  std::size_t waypoint = 0;          ///< The waypoint at its end (straight) or beside it (arc).
  bool ends_in_corner = false;       ///< Ends at a waypoint where the motion has to stop.

  [[nodiscard]] double end() const { return begin + length; }
  [[nodiscard]] bool is_arc() const { return radius > 0.0; }
  [[nodiscard]] bool is_smooth_arc() const { return turn.size() > 0; }
  /// dⁿq/dsⁿ, 0 ≤ n ≤ 3: the position for order 0.
  [[nodiscard]] geometric::Configuration derivative(int order, double s) const;
  /// Upper bound of |dq/ds| of each joint over the piece.
  [[nodiscard]] geometric::Configuration fastest() const;
};

/// A path whose corners are rounded by arcs, differentiable enough for velocity limits, or, with
/// smooth arcs, for jerk limits. Lengths are Euclidean in the joints' units (rad, m).
///
/// Source: Kunz, Stilman, "Time-optimal trajectory generation for path following with bounded
/// acceleration and velocity", RSS 2012, section IV: an arc takes at most half of either edge, and
/// passes its waypoint within the allowed deviation.
class HANDWAY_PLANNING_EXPORT BlendedPath {
 public:
  /// @param deviations largest distance of each arc from its waypoint, shape [waypoints], first and
  /// last without meaning; 0 leaves the corner.
  /// @throws std::invalid_argument if shapes differ or a value is not finite or below 0.
  BlendedPath(const Path& path, const std::vector<double>& deviations,
              ArcShape shape = ArcShape::kCircular);

  [[nodiscard]] double length() const { return pieces_.empty() ? 0.0 : pieces_.back().end(); }
  /// Pieces of the path; none if all waypoints are the same.
  [[nodiscard]] const std::vector<PathPiece>& pieces() const { return pieces_; }
  /// The piece at arc length s; at a join the later one. @pre the path has pieces.
  [[nodiscard]] const PathPiece& piece_at(double s) const;
  /// Arc length at which each waypoint is passed, in the middle of its arc; shape [waypoints].
  [[nodiscard]] const std::vector<double>& passages() const { return passages_; }
  /// Distance of each waypoint from its arc; shape [waypoints], 0: the path goes through it.
  [[nodiscard]] const std::vector<double>& deviations() const { return deviations_; }
  [[nodiscard]] const Path& polyline() const { return polyline_; }

 private:
  Path polyline_;
  std::vector<PathPiece> pieces_;
  std::vector<double> deviations_;
  std::vector<double> passages_;
};

/// Options of rounding a path's waypoints.
struct BlendOptions {
  /// Largest distance of an arc from its waypoint (rad or m, Euclidean over the joints); 0: the
  /// motion stops at every waypoint.
  double deviation = 0.05;
  ArcShape shape = ArcShape::kCircular;
  /// An arc keeps at least this from everything (m) …
  double arc_clearance = 1e-3;
  /// … and straight parts this: the certificate's resolution.
  double resolution = 5e-5;
  std::stop_token stop = {};  ///< Blending ends with geometric::PreparationStopped.
};

/// A blended path that is free of collision all along, or the reason for its absence.
struct BlendResult {
  std::optional<BlendedPath> path;
  std::string fault;  ///< A sentence; empty with a path.
  int arcs = 0;
  int reduced = 0;                 ///< Arcs that were reduced to keep their clearance.
  int stops = 0;                   ///< Corners where the motion has to stop.
  double largest_deviation = 0.0;  ///< rad or m
};

/// Rounds the corners of a path without leaving free space. Every edge is checked again, then every
/// arc, by conservative advancement: from a checked configuration as far as the joints can't have
/// used up its clearance. The deviation of an arc that is not free is halved, until it is free, or
/// until no arc is left and the motion stops at the waypoint.
/// @throws InputError if the path has no waypoints, or one that is not a configuration of the robot
/// within its limits.
[[nodiscard]] HANDWAY_PLANNING_EXPORT BlendResult certified_blends(
    const PlanningProblem& problem, const Path& path, const BlendOptions& options = {});

}  // namespace handway::planning
