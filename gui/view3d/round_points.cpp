#include "view3d/round_points.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/elements/SoGLLazyElement.h>

#include <GL/gl.h>

namespace handway::gui {

SO_NODE_SOURCE(RoundPoints);

void RoundPoints::initClass() { SO_NODE_INIT_CLASS(RoundPoints, SoPointSet, "PointSet"); }

RoundPoints::RoundPoints() {
  if (getClassTypeId() == SoType::badType()) {
    initClass();
  }
  SO_NODE_CONSTRUCTOR(RoundPoints);
}

void RoundPoints::GLRender(SoGLRenderAction* action) {
  glPushAttrib(GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT | GL_POINT_BIT);
  glDisable(GL_MULTISAMPLE);  // under which some drivers draw squares
  glEnable(GL_POINT_SMOOTH);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  SoPointSet::GLRender(action);
  glPopAttrib();
  // Coin has to send its own state again: it can't know that it was put back.
  SoGLLazyElement::getInstance(action->getState())
      ->reset(action->getState(), SoLazyElement::ALL_MASK);
}

}  // namespace handway::gui
