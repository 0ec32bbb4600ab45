#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/timing/time_path.h"

#include <QString>

#include <functional>
#include <string>
#include <vector>

namespace handway::gui {

/// Something that becomes a motion when it is timed: a path, or a planned task. It is timed off the
/// GUI thread, and again with other options.
struct MotionSource {
  QString title;  ///< Of a dialog: "Export the path".
  QString name;   ///< Proposed name of the motion.
  /// @param name see planning::Motion::name. @param options their stop ends the timing with
  /// geometric::PreparationStopped.
  std::function<planning::TimedPath(const std::string& name,
                                    const planning::TimingOptions& options)>
      time;
  /// Scenes of the motion's stages; empty for a path, which has none.
  std::vector<planning::SceneState> scenes = {};
};

/// A source, and the revision of the scene that it was made from.
using DerivedSource = planning::Derived<MotionSource>;

}  // namespace handway::gui
