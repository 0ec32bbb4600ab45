#pragma once

#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <vector>

class SoDrawStyle;
class SoGLRenderAction;

namespace handway::gui {

/// A line around each thing that is selected, seen through everything: the parts' edges
/// drawn wide wherever the part itself is not.
class SelectionOutline {
 public:
  SelectionOutline();
  ~SelectionOutline();
  SelectionOutline(const SelectionOutline&) = delete;
  SelectionOutline& operator=(const SelectionOutline&) = delete;

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
