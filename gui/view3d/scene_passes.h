#pragma once

#include "view3d/coin_conversions.h"
#include "view3d/overlay.h"
#include "view3d/scene_bodies.h"

#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <array>
#include <map>
#include <optional>

class SoGroup;

namespace handway::gui {

/// Three unit arrows from the origin: x red, y green, z blue.
[[nodiscard]] CoinRef<SoSeparator> make_axes_node();

/// Key and fill light that go with the camera; belongs before it in the graph.
[[nodiscard]] CoinRef<SoGroup> make_camera_lights();

/// A weak light from above, standing in the world; belongs after the camera.
[[nodiscard]] CoinRef<SoGroup> make_sky_light();

/// Overlays that stay while a robot moves.
inline constexpr std::array kStillOverlays{Overlay::kPath, Overlay::kRoadmap, Overlay::kTrails,
                                           Overlay::kSteps, Overlay::kHypercubes};

/// One root a pass, all seen by the same camera under the same lights.
struct ScenePasses {
  CoinRef<SoPerspectiveCamera> perspective = make_coin<SoPerspectiveCamera>();
  CoinRef<SoOrthographicCamera> orthographic = make_coin<SoOrthographicCamera>();
  CoinRef<SoSwitch> camera = make_coin<SoSwitch>();  ///< One of the two.
  CoinRef<SoGroup> camera_lights = make_camera_lights();
  CoinRef<SoGroup> sky_light = make_sky_light();
  CoinRef<SoComplexity> detail = make_coin<SoComplexity>();  ///< Level of detail of meshes.
  CoinRef<SoSeparator> solids = make_coin<SoSeparator>();
  CoinRef<SoSeparator> solid_content = make_coin<SoSeparator>();
  CoinRef<SoSeparator> floor = make_coin<SoSeparator>();
  CoinRef<SoSwitch> floor_content = make_coin<SoSwitch>();
  CoinRef<SoSeparator> drawings = make_coin<SoSeparator>();        ///< All overlays.
  CoinRef<SoSeparator> still_drawings = make_coin<SoSeparator>();  ///< Overlays that stand still.
  CoinRef<SoOrthographicCamera> lamp = make_coin<SoOrthographicCamera>();
  CoinRef<SoSeparator> lamp_view = make_coin<SoSeparator>();
  CoinRef<SoSeparator> shadow_casters = make_coin<SoSeparator>();
  std::map<Overlay, CoinRef<SoSwitch>> overlays;
  CoinRef<SoSeparator> gizmo = make_coin<SoSeparator>();
  CoinRef<SoOrthographicCamera> axes_camera = make_coin<SoOrthographicCamera>();
  CoinRef<SoSeparator> axes = make_coin<SoSeparator>();
  static constexpr int kGizmo = 4;  ///< Index in `gizmo`, after what prepare() adds.
  std::optional<StillSplit> split;  ///< For fast pictures of solids.

  ScenePasses() {
    camera->addChild(perspective.get());
    camera->addChild(orthographic.get());
    camera->whichChild = 0;
    set_fine(true);
    for (SoSeparator* root :
         {solids.get(), floor.get(), gizmo.get(), drawings.get(), still_drawings.get()}) {
      prepare(root);
    }
    auto still = make_coin<SoSeparator>();
    auto moving = make_coin<SoSeparator>();
    prepare(still.get());
    prepare(moving.get());
    split.emplace(still, moving);
    solids->addChild(solid_content.get());
    for (const Overlay overlay :
         {Overlay::kPath, Overlay::kRoadmap, Overlay::kRegion, Overlay::kExecuted,
          Overlay::kOptimized, Overlay::kContacts, Overlay::kClearance, Overlay::kTrails,
          Overlay::kSteps, Overlay::kHypercubes, Overlay::kConstraints, Overlay::kMeasure,
          Overlay::kFrames, Overlay::kGoalPoses, Overlay::kReach, Overlay::kGrasp}) {
      const CoinRef<SoSwitch> shown = make_coin<SoSwitch>();
      shown->whichChild = SO_SWITCH_ALL;
      drawings->addChild(shown.get());
      overlays.emplace(overlay, shown);
    }
    for (const Overlay overlay : kStillOverlays) {
      still_drawings->addChild(overlays.at(overlay).get());
    }
    prepare_lamp();
    solid_content->renderCaching = SoSeparator::OFF;
    floor->addChild(floor_content.get());
    floor_content->whichChild = SO_SWITCH_ALL;
    axes->addChild(camera_lights.get());
    axes->addChild(axes_camera.get());
    axes->addChild(make_axes_node().get());
  }

  /// Meshes as they are, or as coarse as can't be seen.
  void set_fine(bool fine) const {
    if (const float value = fine ? 1.0F : 0.5F; detail->value.getValue() != value) {
      detail->value = value;
    }
  }

  void prepare_lamp() const {
    auto* unlit = new SoLightModel;
    unlit->model = SoLightModel::BASE_COLOR;
    lamp_view->renderCaching = SoSeparator::OFF;
    shadow_casters->renderCaching = SoSeparator::OFF;
    lamp_view->addChild(lamp.get());
    lamp_view->addChild(unlit);
    lamp_view->addChild(detail.get());
    lamp_view->addChild(shadow_casters.get());
  }

  void prepare(SoSeparator* root) const {
    root->renderCaching = SoSeparator::OFF;
    root->addChild(camera_lights.get());
    root->addChild(camera.get());
    root->addChild(sky_light.get());
    root->addChild(detail.get());
  }
};

}  // namespace handway::gui
