#include "view3d/scene_passes.h"

#include "view3d/robot_node.h"

#include <Inventor/SbColor.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoRotation.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoTranslation.h>

#include <GL/gl.h>

namespace handway::gui {
namespace {

SoSeparator* make_arrow(const SbVec3f& direction, const geometric::Color& color) {
  auto* arrow = new SoSeparator;
  arrow->addChild(make_material(color).get());
  auto* turn = new SoRotation;
  turn->rotation = SbRotation(SbVec3f(0.0F, 1.0F, 0.0F), direction);
  arrow->addChild(turn);
  auto* up = new SoTranslation;
  up->translation = SbVec3f(0.0F, 0.375F, 0.0F);
  arrow->addChild(up);
  auto* shaft = new SoCylinder;
  shaft->radius = 0.045F;
  shaft->height = 0.75F;
  arrow->addChild(shaft);
  arrow->addChild(up);
  auto* tip = new SoCone;
  tip->bottomRadius = 0.12F;
  tip->height = 0.32F;
  arrow->addChild(tip);
  return arrow;
}

}  // namespace

CoinRef<SoSeparator> make_axes_node() {
  auto axes = make_coin<SoSeparator>();
  axes->addChild(make_arrow({1.0F, 0.0F, 0.0F}, {0.82F, 0.22F, 0.20F, 1.0F}));
  axes->addChild(make_arrow({0.0F, 1.0F, 0.0F}, {0.24F, 0.62F, 0.26F, 1.0F}));
  axes->addChild(make_arrow({0.0F, 0.0F, 1.0F}, {0.18F, 0.40F, 0.82F, 1.0F}));
  return axes;
}

namespace {

SoDirectionalLight* make_light(const SbVec3f& direction, float intensity, const SbColor& color) {
  auto* light = new SoDirectionalLight;
  light->direction = direction;
  light->intensity = intensity;
  light->color = color;
  return light;
}

}  // namespace

CoinRef<SoGroup> make_camera_lights() {
  auto group = make_coin<SoGroup>();
  auto* environment = new SoEnvironment;
  environment->ambientIntensity = 0.30F;
  group->addChild(environment);
  group->addChild(make_light({0.45F, -0.65F, -0.70F}, 0.62F, {1.0F, 0.985F, 0.96F}));
  group->addChild(make_light({-0.75F, -0.10F, -0.55F}, 0.22F, {0.90F, 0.94F, 1.0F}));
  return group;
}

CoinRef<SoGroup> make_sky_light() {
  auto group = make_coin<SoGroup>();
  group->addChild(make_light({0.10F, 0.15F, -1.0F}, 0.25F, {0.95F, 0.97F, 1.0F}));
  return group;
}

namespace {

// More than these have one line around all of them.
constexpr int kMostApart = 30;

const SbColor kColor(1.0F, 0.62F, 0.05F);

}  // namespace

SelectionOutline::SelectionOutline()
    : root_(make_coin<SoSeparator>()),
      style_(make_coin<SoDrawStyle>()),
      looks_(make_coin<SoSeparator>()),
      parts_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  looks_->renderCaching = SoSeparator::OFF;
  auto* unlit = new SoLightModel;
  unlit->model = SoLightModel::BASE_COLOR;
  unlit->setOverride(TRUE);
  auto* color = new SoMaterial;
  color->diffuseColor = kColor;
  color->setOverride(TRUE);
  style_->setOverride(TRUE);
  looks_->addChild(unlit);
  looks_->addChild(color);
  looks_->addChild(style_.get());
  looks_->addChild(parts_.get());
  root_->addChild(looks_.get());
}

SelectionOutline::~SelectionOutline() = default;

void SelectionOutline::set_parts(const std::vector<SoSeparator*>& parts) {
  parts_->removeAllChildren();
  for (SoSeparator* part : parts) {
    parts_->addChild(part);
  }
}

bool SelectionOutline::is_shown() const { return parts_->getNumChildren() > 0; }

void SelectionOutline::render(SoGLRenderAction& action, float width) const {
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

void SelectionOutline::draw(SoGLRenderAction& action, float width) const {
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
