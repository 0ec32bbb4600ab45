#pragma once

#include "handway/geometric/math/units.h"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace handway::gui {

/// Directions to look from; the robot's front is +x, up is +z.
enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kOblique };

enum class Projection { kPerspective, kOrthographic };

/// A camera on a turntable around `target`; the horizon stays level.
class OrbitCamera {
 public:
  /// Position of the camera relative to the target.
  struct Placement {
    Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< World, m.
    double distance = 3.0;                             ///< From the target, m.
    double azimuth = geometric::radians(-55.0);        ///< About +z from +x.
    double elevation = geometric::radians(18.0);       ///< Above the horizon.
  };

  static constexpr double kFieldOfView = geometric::radians(32.0);  ///< Vertical.

  [[nodiscard]] Projection projection() const { return projection_; }
  /// Sets the projection. Bodies at the target's depth keep their size.
  void set_projection(Projection projection) { projection_ = projection; }
  [[nodiscard]] const Placement& placement() const { return placement_; }
  void set_placement(const Placement& placement);

  [[nodiscard]] Eigen::Vector3d position() const;
  /// Columns: right, up and backwards of the camera, in the world.
  [[nodiscard]] Eigen::Matrix3d orientation() const;

  /// Height (m) of what the picture shows at a depth before the camera, m.
  [[nodiscard]] double seen_height(double depth) const;

  /// Turns about the target, rad.
  void orbit(double azimuth, double elevation);
  /// Moves the target with the picture: fractions of the view's height, right and up.
  void pan(double right, double up);
  /// Multiplies the distance; the point under the cursor stays where it is.
  /// @param right, up the cursor's place from the middle, in fractions of the view's height.
  void zoom(double factor, double right, double up);

  /// Turns to `view`, keeping target and distance. `front` is the azimuth of +x's role.
  void look_from(StandardView view, double front = 0.0);

  /// Moves so that all points (world, m) just fit into the picture with a margin.
  /// @param aspect width / height.
  void fit(std::span<const Eigen::Vector3d> points, double aspect, double margin = 1.08);
  /// Returns the position of a point (world, m) in the picture: right of its middle and above it,
  /// in fractions of the view's height; nothing if it is behind the camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> place_of(const Eigen::Vector3d& point) const;
  /// Returns whether all points (world, m) are in the picture. @param aspect width / height.
  [[nodiscard]] bool sees(std::span<const Eigen::Vector3d> points, double aspect) const;

 private:
  void fit_in_perspective(std::span<const Eigen::Vector3d> points, double aspect, double margin);
  void fit_in_parallel(std::span<const Eigen::Vector3d> points, double aspect, double margin);

  Placement placement_;
  Projection projection_ = Projection::kPerspective;
};

/// The way from `a` (t = 0) to `b` (t = 1), turning the short way round.
[[nodiscard]] OrbitCamera::Placement interpolate(const OrbitCamera::Placement& a,
                                                 const OrbitCamera::Placement& b, double t);

}  // namespace handway::gui
