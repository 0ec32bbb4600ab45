#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"

#include <Eigen/Core>

#include <optional>

namespace handway::gui {

/// A half-line in the world, m; `direction` has length 1.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// Parts that can be dragged: arrows along three axes, plates between two, rings about one, or the
/// body itself, which is carried from surface to surface.
struct GizmoHandle {
  enum class Kind { kArrow, kPlate, kRing, kBody };
  Kind kind = Kind::kArrow;
  int axis = 0;  ///< Axis of the arrow or ring; the plate's normal.

  friend bool operator==(const GizmoHandle&, const GizmoHandle&) = default;
};

/// Pose and proportions of a gizmo.
struct GizmoFrame {
  static constexpr double kArrowFrom = 0.18;
  static constexpr double kArrowTo = 1.0;
  static constexpr double kRingRadius = 0.78;
  static constexpr double kPlateFrom = 0.24;
  static constexpr double kPlateTo = 0.40;
  static constexpr double kReach = 0.075;  ///< Largest distance that hits a handle.

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< World, m.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< Columns; world.
  double size = 1.0;                                   ///< m per unit of the above.
};

/// The handle that the ray passes closest to, of those it hits.
[[nodiscard]] std::optional<GizmoHandle> handle_at(const GizmoFrame& frame, const Ray& ray);

/// A pull at one handle.
class GizmoDrag {
 public:
  static constexpr double kSnapLength = 0.01;                     ///< m
  static constexpr double kSnapAngle = geometric::radians(15.0);  ///< rad

  /// @param X_WO what is dragged. @param ray where it was taken hold of.
  GizmoDrag(const GizmoHandle& handle, const GizmoFrame& frame, const geometric::Pose& X_WO,
            const Ray& ray);

  [[nodiscard]] const GizmoHandle& handle() const { return handle_; }
  [[nodiscard]] const geometric::Pose& start() const { return X_WO_; }

  /// Returns the pose after dragging to `ray`, unless it is the body that is dragged. @param snap
  /// in steps of kSnapLength or kSnapAngle: along the axes of the world onto their round values,
  /// otherwise from the initial pose.
  [[nodiscard]] geometric::Pose moved_to(const Ray& ray, bool snap);
  /// Returns the nearest amount that ends on round values of the world, horizontally.
  [[nodiscard]] Eigen::Vector3d snapped(const Eigen::Vector3d& amount) const;
  /// Returns the pose after a move by a given amount, see amount(), along axes that the handle
  /// leaves free.
  [[nodiscard]] geometric::Pose moved_by(const Eigen::Vector3d& amount);
  /// Returns whether the handle moves along an axis, or turns about it.
  [[nodiscard]] bool is_free(int axis) const {
    return handle_.kind == GizmoHandle::Kind::kBody ||
           (axis == handle_.axis) == (handle_.kind != GizmoHandle::Kind::kPlate);
  }
  /// Returns the amount of the last moved_to(): along the axes, m; for a ring about its axis, rad.
  [[nodiscard]] const Eigen::Vector3d& amount() const { return amount_; }

 private:
  [[nodiscard]] double along_axis(const Ray& ray) const;
  [[nodiscard]] Eigen::Vector3d on_plane(const Ray& ray) const;
  [[nodiscard]] double angle_about_axis(const Ray& ray) const;
  [[nodiscard]] double snapped_step(int axis, double step) const;

  GizmoHandle handle_;
  GizmoFrame frame_;
  geometric::Pose X_WO_;
  Eigen::Vector3d amount_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangent_ = Eigen::Vector3d::Zero();  ///< Tangent of a ring at the grabbed point.
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();     ///< The point that was taken.
  double held_along_ = 0.0;
  double held_angle_ = 0.0;
};

}  // namespace handway::gui
