#pragma once

#include "handway/geometric/scene/color.h"
#include "handway/geometric/scene/triangle_mesh.h"
#include "view3d/coin_ref.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <memory>

namespace handway::gui {

/// The drawing of a body in its own frame, with its colours: its looks, or a mesh in their place.
/// Copies share the drawing.
class BodyShape {
 public:
  /// @param looks with materials. @param color of a mesh in their place.
  BodyShape(const CoinRef<SoSeparator>& looks, const geometric::Color& color);

  [[nodiscard]] SoSeparator* get() const { return root_.get(); }
  /// Draws a mesh in place of the looks; null: the looks.
  void stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const;

 private:
  geometric::Color color_;
  CoinRef<SoSeparator> root_;
  CoinRef<SoSwitch> drawings_;  ///< Looks, then the mesh, if there is one.
};

}  // namespace handway::gui
