#include "model/document/resting.h"

#include "model/document/arrange.h"
#include "model/document/drop_height.h"
#include "model/document/scene_edits.h"
#include "model/document/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::gui {

using geometric::Pose;
using geometric::SceneObject;

namespace {

constexpr double kInContact = 1e-3;
constexpr double kNoMove = 1e-12;

}  // namespace

SceneState dropped(SceneState state, const geometric::Configuration& q,
                   const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> parts = rigid_parts(*state.scene, names);
  std::ranges::stable_sort(parts, {}, [&](const std::vector<std::string>& part) {
    return bounds(*state.scene, q, part).lower.z();
  });
  for (const std::vector<std::string>& part : parts) {
    const SceneState others = without_objects(state, part);
    double height = std::numeric_limits<double>::infinity();
    for (const std::string& name : part) {
      const SceneObject& object = *state.find(name);
      height = std::min(height, height_above_floor(object));
      if (const auto gap = gap_to_support(*others.scene, object)) {
        height = std::min(height, *gap - kRestingGap);
      }
    }
    if (std::abs(height) > kNoMove) {
      state = moved(state, q, part, Pose(Eigen::Translation3d(0.0, 0.0, -height)));
    }
  }
  return state;
}

double rise_to_clear(const SceneState& state, const std::vector<std::string>& names) {
  const SceneState others = without_objects(state, names);
  double rise = 0.0;
  for (const std::string& name : names) {
    const SceneObject& object = *state.find(name);
    const auto gap = object.attachment ? std::nullopt : gap_to_support(*others.scene, object);
    if (gap && *gap >= -kInContact) {
      rise = std::max(rise, kRestingGap - *gap);
    }
  }
  return rise > kNoMove ? rise : 0.0;
}

}  // namespace handway::gui
