#pragma once

#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <vector>

class SoDrawStyle;
class SoGLRenderAction;

namespace handway::gui {

/// A line around each of several bodies, seen through everything: the parts' edges
/// drawn wide wherever the part itself is not.
class BodyOutline {
 public:
  explicit BodyOutline(const geometric::Color& color);
  ~BodyOutline();
  BodyOutline(const BodyOutline&) = delete;
  BodyOutline& operator=(const BodyOutline&) = delete;

  /// The root that a camera goes into, once.
  [[nodiscard]] SoSeparator* root() const { return root_.get(); }
  /// @param parts drawings in the world.
  void set_parts(const std::vector<SoSeparator*>& parts);
  [[nodiscard]] bool is_shown() const;
  /// @pre the target has a stencil buffer. @param width of the line, pixels.
  void render(SoGLRenderAction& action, float width) const;

 private:
  void draw(SoGLRenderAction& action, float width) const;

  CoinRef<SoSeparator> root_;
  CoinRef<SoDrawStyle> style_;
  CoinRef<SoSeparator> looks_;
  CoinRef<SoSwitch> parts_;
};

}  // namespace handway::gui
