#include "view3d/scene_passes.h"

#include "view3d/shape_node.h"

#include <Inventor/SbColor.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoRotation.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoTranslation.h>

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

SoDirectionalLight* make_light(const SbVec3f& direction, float intensity, const SbColor& color) {
  auto* light = new SoDirectionalLight;
  light->direction = direction;
  light->intensity = intensity;
  light->color = color;
  return light;
}

}  // namespace

CoinRef<SoSeparator> make_axes_node() {
  auto axes = make_coin<SoSeparator>();
  axes->addChild(make_arrow({1.0F, 0.0F, 0.0F}, {0.82F, 0.22F, 0.20F, 1.0F}));
  axes->addChild(make_arrow({0.0F, 1.0F, 0.0F}, {0.24F, 0.62F, 0.26F, 1.0F}));
  axes->addChild(make_arrow({0.0F, 0.0F, 1.0F}, {0.18F, 0.40F, 0.82F, 1.0F}));
  return axes;
}

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

}  // namespace handway::gui
