#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"

#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// An attached object that a hand holds.
struct CarriedObject {
  std::string name;
  /// The joints that hold it, as variables, ascending: joints of the hand that move its links
  /// against each other; a wrist does not.
  geometric::JointIndices holding;
};

/// The objects that hands of the first robot hold: attached to a palm or to objects held by it, or
/// allowed to touch a link that a finger's joint moves. Objects attached elsewhere, as a tool at
/// the flange or a camera at the forearm, are not included.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CarriedObject> carried_objects(
    const geometric::Scene& scene);

/// Warns about joints that move on a path while they hold an object: an attached object keeps its
/// pose in the palm, whatever the fingers do. A sentence for each object; empty if all stay.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> holding_warnings(
    const geometric::Scene& scene, std::span<const geometric::Configuration> waypoints);

}  // namespace handway::planning
