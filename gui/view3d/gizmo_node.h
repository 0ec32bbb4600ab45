#pragma once

#include "view3d/coin_conversions.h"
#include "view3d/drawing.h"
#include "view3d/gizmo_drag.h"

#include <Eigen/Core>

#include <optional>
#include <span>

class SoMatrixTransform;
class SoScale;
class SoSeparator;

namespace handway::gui {

/// Small squares, always of the same size on the screen. @param points world, m.
/// @param hot index of the one that is under the pointer or held.
[[nodiscard]] Drawing make_knobs_node(std::span<const Eigen::Vector3d> points,
                                      std::optional<int> hot);

/// The drawing of a gizmo: red, green and blue arrows, plates and rings; what is
/// under the pointer or held is bright, and while it is held the rest is gone.
class GizmoNode {
 public:
  GizmoNode();
  ~GizmoNode();
  GizmoNode(const GizmoNode&) = delete;
  GizmoNode& operator=(const GizmoNode&) = delete;

  [[nodiscard]] SoSeparator* root() const { return root_.get(); }

  void place(const GizmoFrame& frame);
  /// @param hot under the pointer. @param held nothing else is shown.
  void set_hot(const std::optional<GizmoHandle>& hot, bool held);

 private:
  void rebuild();

  CoinRef<SoSeparator> root_;
  CoinRef<SoMatrixTransform> transform_;
  CoinRef<SoScale> scale_;
  CoinRef<SoSeparator> handles_;
  std::optional<GizmoHandle> hot_;
  bool held_ = false;
};

}  // namespace handway::gui
