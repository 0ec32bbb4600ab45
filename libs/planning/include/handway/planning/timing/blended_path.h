#pragma once

#include "handway/planning/core/path.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <vector>

namespace handway::planning {

/// How corners are rounded.
enum class ArcShape {
  kCircular,  ///< Of constant curvature, which jumps at both ends: as fast as can be.
  kSmooth,    ///< Curvature rises from 0 and falls to it: jerk can be limited.
};

/// A part of a BlendedPath: straight, or an arc in configuration space.
/// At parameter s from its beginning (arc length, but for smooth arcs) the joints are at
///   straight      origin + s t
///   circular arc  origin + r sin(s/r) t + r (1 - cos(s/r)) n
///   smooth arc    origin + s t + l (x³ - x⁴/2) (u - t),  x = s / l, l the length
/// where u is the direction in which it ends: of a smooth arc dq/ds turns from t to u by
/// t + (3 x² - 2 x³) (u - t), and is shorter than 1 between.
struct HANDWAY_PLANNING_EXPORT PathPiece {
  double length = 0.0;
  double radius = 0.0;               ///< r; 0: straight; of a smooth arc length by angle.
  geometric::Configuration origin;   ///< Where it begins.
  geometric::Configuration tangent;  ///< t, of length 1: the direction in which it begins.
  geometric::Configuration normal;   ///< n, of length 1, square to t; of zeros if straight.
  geometric::Configuration turn;     ///< u - t of a smooth arc; of size 0: it is none.
  std::size_t waypoint = 0;     ///< The waypoint that it ends in (straight) or goes around (arc).
  bool ends_in_corner = false;  ///< It ends at a waypoint where the motion has to stop.

  [[nodiscard]] bool is_arc() const { return radius > 0.0; }
  [[nodiscard]] bool is_smooth_arc() const { return turn.size() > 0; }
  [[nodiscard]] geometric::Configuration position(double s) const;
  [[nodiscard]] geometric::Configuration first_derivative(double s) const;   ///< dq/ds
  [[nodiscard]] geometric::Configuration second_derivative(double s) const;  ///< d²q/ds²
  [[nodiscard]] geometric::Configuration third_derivative(double s) const;   ///< d³q/ds³
  /// What |dq/ds| of each joint stays below all along.
  [[nodiscard]] geometric::Configuration fastest() const;
};

/// A path whose corners are rounded by arcs, as differentiable as velocity limits need it, or, with
/// smooth ones, jerk limits. Lengths are Euclidean in the joints' units (rad, m).
///
/// Source: Kunz, Stilman, "Time-optimal trajectory generation for path following with
/// bounded acceleration and velocity", RSS 2012, section IV: an arc takes at most half
/// of either edge, and passes its waypoint at no more than the deviation allowed.
class HANDWAY_PLANNING_EXPORT BlendedPath {
 public:
  /// @param deviations how far from each waypoint its arc may pass, shape [waypoints],
  /// first and last without meaning; 0 leaves the corner.
  /// @throws std::invalid_argument if shapes differ or a value is not finite or below 0.
  BlendedPath(const Path& path, const std::vector<double>& deviations,
              ArcShape shape = ArcShape::kCircular);

  [[nodiscard]] double length() const { return length_; }
  /// None if all waypoints are the same.
  [[nodiscard]] const std::vector<PathPiece>& pieces() const { return pieces_; }
  /// How far each waypoint's arc really passes from it; shape [waypoints], 0: through it.
  [[nodiscard]] const std::vector<double>& deviations() const { return deviations_; }
  [[nodiscard]] const Path& polyline() const { return polyline_; }

 private:
  Path polyline_;
  std::vector<PathPiece> pieces_;
  std::vector<double> deviations_;
  double length_ = 0.0;
};

}  // namespace handway::planning
