#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/extensions/plugin.h"

#include <string>

namespace handway::gui {

/// A scene with nothing but a robot of the library, and the first hand basis of the library that
/// fits it. An arm stands on a table, and all of it in ready_posture(); where that collides, the
/// hand is turned on its seat, or the nearest free posture is taken.
/// @param hand of the library, mounted on the end of the robot's arm; empty: none.
/// @throws InputError if there is no such robot, or the robot has no end to mount a hand on.
[[nodiscard]] planning::SceneState new_scene(const std::string& robot, const std::string& hand,
                                             const planning::PluginManager& plugins);

/// The posture that a robot is best shown in first: of each of its groups the one that its files
/// call "ready" or "home", or else the neutral one.
[[nodiscard]] geometric::Configuration ready_posture(const geometric::RobotModel& model);

}  // namespace handway::gui
