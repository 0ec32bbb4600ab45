#include "view3d/body_outline.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <GL/gl.h>

namespace handway::gui {
namespace {

// More than these have one line around all of them.
constexpr int kMostApart = 30;

}  // namespace

BodyOutline::BodyOutline(const geometric::Color& color)
    : root_(make_coin<SoSeparator>()),
      style_(make_coin<SoDrawStyle>()),
      looks_(make_coin<SoSeparator>()),
      parts_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  looks_->renderCaching = SoSeparator::OFF;
  auto* unlit = new SoLightModel;
  unlit->model = SoLightModel::BASE_COLOR;
  unlit->setOverride(TRUE);
  auto* paint = new SoMaterial;
  paint->diffuseColor = to_coin(color);
  paint->setOverride(TRUE);
  style_->setOverride(TRUE);
  looks_->addChild(unlit);
  looks_->addChild(paint);
  looks_->addChild(style_.get());
  looks_->addChild(parts_.get());
  root_->addChild(looks_.get());
}

BodyOutline::~BodyOutline() = default;

void BodyOutline::set_parts(const std::vector<SoSeparator*>& parts) {
  parts_->removeAllChildren();
  for (SoSeparator* part : parts) {
    parts_->addChild(part);
  }
}

bool BodyOutline::is_shown() const { return parts_->getNumChildren() > 0; }

void BodyOutline::render(SoGLRenderAction& action, float width) const {
  if (!is_shown()) {
    return;
  }
  const int count = parts_->getNumChildren();
  if (count > kMostApart) {
    parts_->whichChild = SO_SWITCH_ALL;
    draw(action, width);
    return;
  }
  for (int part = 0; part < count; ++part) {
    parts_->whichChild = part;
    draw(action, width);
  }
}

void BodyOutline::draw(SoGLRenderAction& action, float width) const {
  glEnable(GL_STENCIL_TEST);
  glClearStencil(0);
  glClear(GL_STENCIL_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  action.setTransparencyType(SoGLRenderAction::NONE);
  glStencilFunc(GL_ALWAYS, 1, 1);
  glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  style_->style = SoDrawStyle::FILLED;
  action.apply(root_.get());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  glStencilFunc(GL_EQUAL, 0, 1);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  style_->style = SoDrawStyle::LINES;
  style_->lineWidth = width;
  action.apply(root_.get());
  glDisable(GL_STENCIL_TEST);
}

}  // namespace handway::gui
