#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <string>
#include <vector>

namespace handway::planning {

/// Draws poses in which an object stands on the faces of another one that look upwards, such as a
/// table top or the boards of a shelf. The object keeps its orientation but for turns about the
/// vertical, and geometric::kRestingGap to the face. The middle of its underside is anywhere on
/// the faces, and all of its underside is above them. What else may be in the way is not looked
/// at. Same arguments, same bits.
/// @param object stands in the world; its X_PO gives the orientation.
/// @param support another object of the scene, which stands in the world.
/// @param count of poses at most; fewer if the faces are small.
/// @returns poses of the object in the world; none if there is no such face.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::Pose> resting_places(
    const geometric::Scene& scene, const geometric::SceneObject& object, const std::string& support,
    int count, std::uint64_t seed);

/// Returns poses in which an object stands in a frame: the middle of its underside is on the z
/// axis, geometric::kRestingGap above the origin. In the first it keeps its orientation, but for
/// the inclination of z against the vertical; in the others it is turned about z.
/// @param X_WF the frame in the world. @param count of poses.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::Pose> places_at(
    const geometric::SceneObject& object, const geometric::Pose& X_WF, int count);

/// Returns the objects that another one can be placed on: those that stand in the world. The one
/// that it stands on comes first, those that it is not above come last.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> supports_of(
    const geometric::Scene& scene, const geometric::SceneObject& object);

}  // namespace handway::planning
