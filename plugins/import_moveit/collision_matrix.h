#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <map>
#include <string>
#include <vector>

namespace handway::import_moveit {

/// Reads a flag in the form of rostopic and ros2, or as a number.
[[nodiscard]] bool flag(const geometric::YamlElement& element);

/// Names in `scene` of a collision object's shapes, by its id.
using ObjectNames = std::map<std::string, std::vector<std::string>>;

/// Converts moveit_msgs/AllowedCollisionMatrix to Scene::allowed_collisions. A matrix with names
/// replaces that of the robot's SRDF: two links that it names may touch if the matrix allows it.
/// For a pair that it does not name the defaults of its bodies decide: one allows contact if that
/// of the other does not forbid it. Without either, links that it does not name keep the SRDF's
/// pairs, with a warning if that makes a difference, and pairs with objects are checked. An
/// attached object may touch its touch links in any case.
/// @throws InputError if the lengths of its rows differ from the number of names.
void read_collision_matrix(const geometric::YamlElement& matrix, const ObjectNames& objects,
                           geometric::Scene& scene);

/// Reads `link_padding` and `link_scale` of a moveit_msgs/PlanningScene, for the first robot.
/// Unknown links are ignored with a warning.
/// @throws InputError for a scale of 0 or less, or a negative padding.
void read_paddings(const geometric::YamlElement& planning_scene, geometric::Scene& scene);

}  // namespace handway::import_moveit
