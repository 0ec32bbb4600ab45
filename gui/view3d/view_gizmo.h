#pragma once

#include "model/document/selection.h"
#include "model/settings/orbit_camera.h"
#include "view3d/gizmo_drag.h"

#include <QPointF>
#include <QSize>
#include <QString>

#include <array>
#include <optional>

namespace handway::gui {

/// The ray from the camera through a place in the view. @param place, size logical pixels.
[[nodiscard]] Ray ray_through(const OrbitCamera& camera, const QSize& size, const QPointF& place);

/// Returns the position of a point of the world in the view, logical pixels. @pre it is before the
/// camera.
[[nodiscard]] QPointF place_of(const OrbitCamera& camera, const QSize& size,
                               const Eigen::Vector3d& p_W);

/// The gizmo of a view: stands on what is selected, always of the same size on the
/// screen, and turns what the pointer does into poses.
class ViewGizmo {
 public:
  /// @param X_WO nothing: no gizmo. @param p_O its centre in the target's frame, m.
  void set_target(const SceneItem& item, const std::optional<geometric::Pose>& X_WO,
                  const Eigen::Vector3d& p_O = Eigen::Vector3d::Zero());
  void set_local(bool local) { local_ = local; }
  [[nodiscard]] const SceneItem& item() const { return item_; }
  [[nodiscard]] bool is_shown() const { return X_WO_.has_value(); }

  [[nodiscard]] GizmoFrame frame(const OrbitCamera& camera, const QSize& size) const;
  /// The handle under the pointer, or the one that is held.
  [[nodiscard]] const std::optional<GizmoHandle>& hot() const { return hot_; }
  [[nodiscard]] bool is_dragging() const { return drag_.has_value(); }

  /// @returns whether another handle is hot now.
  bool hover(const OrbitCamera& camera, const QSize& size, const QPointF& place);
  /// Grabs the handle at this place, if there is one.
  bool press(const OrbitCamera& camera, const QSize& size, const QPointF& place);
  /// Grabs the target itself. @pre is_shown().
  void press_body(const OrbitCamera& camera, const QSize& size, const QPointF& place);
  /// Returns whether the target itself is held, not a handle.
  [[nodiscard]] bool is_carrying() const {
    return drag_ && drag_->handle().kind == GizmoHandle::Kind::kBody;
  }
  /// Moves the target that is held along the world's axes, m, from where it was grabbed.
  /// @param snap horizontally to multiples of 10 mm. @pre is_carrying().
  geometric::Pose carry(const Eigen::Vector3d& amount, bool snap);
  /// @pre is_dragging(). @returns where the target is now.
  geometric::Pose drag(const OrbitCamera& camera, const QSize& size, const QPointF& place,
                       bool snap);
  /// Moves on along the axes of the world that the handle leaves free. @pre is_dragging().
  geometric::Pose shift(const Eigen::Vector3d& step);
  /// Handles a key of a number that is typed in place of a drag, in mm or degrees: digits, sign,
  /// point, Backspace, and Tab for the plates' other axis. @returns whether it is one.
  bool type(int key, const QString& text);
  /// Returns whether a number has been typed, which replaces the pointer's amount.
  [[nodiscard]] bool has_typed() const;
  /// Releases the handle. @returns the pose of the target when it was grabbed.
  geometric::Pose release();
  /// Releases the handle. @returns the pose of the target when it was grabbed, which it has again.
  geometric::Pose cancel();
  [[nodiscard]] const std::optional<geometric::Pose>& pose() const { return X_WO_; }
  /// Returns how far the target has been dragged: "X +35 mm", "Z −15°".
  [[nodiscard]] QString amount() const;

 private:
  SceneItem item_;
  std::optional<geometric::Pose> X_WO_;
  Eigen::Vector3d p_O_ = Eigen::Vector3d::Zero();  ///< Centre in the target's frame, m.
  std::optional<GizmoHandle> hot_;
  std::optional<GizmoDrag> drag_;
  std::array<QString, 3> typed_;  ///< Along each axis.
  int typed_axis_ = 0;
  bool local_ = false;
};

}  // namespace handway::gui
