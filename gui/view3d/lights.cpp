#include "view3d/lights.h"

#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoGroup.h>

namespace handway::gui {
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

}  // namespace handway::gui
