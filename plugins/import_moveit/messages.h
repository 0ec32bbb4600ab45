#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/geometric/math/pose.h"

#include <map>
#include <string>

namespace handway::import_moveit {

/// Messages of ROS as YAML, the way `rostopic echo` writes them (maps: `{x: 1, y: 2, z: 3}`)
/// and the way MotionBenchMaker does (lists: `[1, 2, 3]`).

/// geometry_msgs/Point and Vector3, m. Coordinates that are missing from a map are 0.
[[nodiscard]] Eigen::Vector3d read_point(const geometric::YamlElement& element);

/// geometry_msgs/Quaternion: x, y, z, w.
/// @throws InputError if its length is not 1 within 1 %.
[[nodiscard]] Eigen::Quaterniond read_rotation(const geometric::YamlElement& element);

/// geometry_msgs/Pose: `position` and `orientation`, each of which may be missing.
[[nodiscard]] geometric::Pose read_pose(const geometric::YamlElement& element);

/// sensor_msgs/JointState: positions by name, rad or m; none if `name` is missing.
/// @throws InputError if there are not as many positions as names.
[[nodiscard]] std::map<std::string, double> read_joint_state(const geometric::YamlElement& element);

}  // namespace handway::import_moveit
