#pragma once

#include "handway/planning/edits/scene_state.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <stop_token>
#include <string>

namespace handway::planning {

/// Measures the grasp that the hand has of an object at a configuration: contacts, quality and
/// squeeze. Fingers that do not touch yet close until they do.
/// @param state with the object free, where it is held.
/// @throws InputError if the robot has no hand there, or fewer than two fingers touch.
[[nodiscard]] Pregrasp measured_grasp(const SceneState& state, const std::string& object,
                                      const Configuration& q, const std::stop_token& stop);

}  // namespace handway::planning
