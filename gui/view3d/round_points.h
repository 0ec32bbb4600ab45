#pragma once

#include <Inventor/nodes/SoPointSet.h>

namespace handway::gui {

/// Points drawn as discs with smooth edges.
class RoundPoints : public SoPointSet {
  SO_NODE_HEADER(RoundPoints);

 public:
  static void initClass();
  RoundPoints();

  void GLRender(SoGLRenderAction* action) override;

 protected:
  ~RoundPoints() override = default;
};

}  // namespace handway::gui
