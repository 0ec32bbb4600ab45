#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/document/body_display.h"

#include <stop_token>

namespace handway::gui {

/// The meshes that stand in for a scene's bodies; none for BodyDisplay::kVisual. May take
/// seconds the first time; the volumes of links are remembered. For any thread.
[[nodiscard]] BodyMeshes body_meshes(const geometric::Scene& scene, BodyDisplay display,
                                     const std::stop_token& stop = {});

}  // namespace handway::gui
