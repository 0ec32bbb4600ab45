#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"

#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// An attached object that a hand holds.
struct CarriedObject {
  std::string name;
  /// The joints that hold it, as variables, ascending: those of the hand that move its links
  /// against each other; a wrist is none.
  std::vector<int> holding;
};

/// The objects that hands of the first robot carry: attached to a palm or to what it carries, or
/// allowed to touch a link that a finger's joint moves. What is attached elsewhere, as a tool at
/// the flange or a camera at the forearm, is none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CarriedObject> carried_objects(
    const geometric::Scene& scene);

/// Variables that stay where they are because they hold something, ascending: the holding joints of
/// all carried_objects(); nothing in a scene with a group, which says itself what moves.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> holding_variables(
    const geometric::Scene& scene);

/// Says which joints move on a path while they hold an object: what is attached stays where it is
/// in the palm, whatever the fingers do. A sentence for each object; empty if all stay.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> holding_warnings(
    const geometric::Scene& scene, std::span<const geometric::Configuration> waypoints);

}  // namespace handway::planning
