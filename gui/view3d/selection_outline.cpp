#include "view3d/selection_outline.h"

#include <Inventor/SbColor.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>

#include <GL/gl.h>

namespace handway::gui {
namespace {

const SbColor kColor(1.0F, 0.62F, 0.05F);

}  // namespace

SelectionOutline::SelectionOutline()
    : root_(make_coin<SoSeparator>()),
      style_(make_coin<SoDrawStyle>()),
      parts_(make_coin<SoSeparator>()) {
  root_->renderCaching = SoSeparator::OFF;
  parts_->renderCaching = SoSeparator::OFF;
  auto* unlit = new SoLightModel;
  unlit->model = SoLightModel::BASE_COLOR;
  unlit->setOverride(TRUE);
  auto* color = new SoMaterial;
  color->diffuseColor = kColor;
  color->setOverride(TRUE);
  style_->setOverride(TRUE);
  parts_->addChild(unlit);
  parts_->addChild(color);
  parts_->addChild(style_.get());
  root_->addChild(parts_.get());
}

SelectionOutline::~SelectionOutline() = default;

void SelectionOutline::set_parts(const std::vector<SoSeparator*>& parts) {
  while (parts_->getNumChildren() > kStyleNodes) {
    parts_->removeChild(kStyleNodes);
  }
  for (SoSeparator* part : parts) {
    parts_->addChild(part);
  }
}

bool SelectionOutline::is_shown() const { return parts_->getNumChildren() > kStyleNodes; }

void SelectionOutline::render(SoGLRenderAction& action, float width) const {
  if (!is_shown()) {
    return;
  }
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
