#include "view3d/frame_drawings.h"

#include "handway/planning/edits/scene_edits.h"
#include "view3d/drawing_parts.h"

#include <Inventor/nodes/SoSeparator.h>

namespace handway::gui {
namespace {

constexpr geometric::Color kFrameColor{0.25F, 0.27F, 0.30F, 1.0F};
constexpr double kAxis = 0.05;  // m

}  // namespace

Drawing make_frames_node(const geometric::Scene& scene, const geometric::Configuration& q) {
  auto separator = make_coin<SoSeparator>();
  for (const geometric::NamedFrame& frame : scene.frames) {
    if (const auto X_WF = planning::frame_pose(scene, q, frame)) {
      add_axes(*separator.get(), *X_WF, kAxis);
      separator->addChild(make_dot(X_WF->translation(), kFrameColor));
    }
  }
  return separator;
}

}  // namespace handway::gui
