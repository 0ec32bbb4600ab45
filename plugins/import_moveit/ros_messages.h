#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Geometry>

#include <map>
#include <string>
#include <utility>
#include <vector>

/// Messages of ROS as YAML, in the forms of `rostopic echo` (maps: `{x: 1, y: 2, z: 3}`) and of
/// MotionBenchMaker (lists: `[1, 2, 3]`).

namespace handway::import_moveit {

/// Collects remarks of the readers of messages below, on this thread during its lifetime.
class Remarks {
 public:
  Remarks();
  ~Remarks();
  Remarks(const Remarks&) = delete;
  Remarks& operator=(const Remarks&) = delete;

  /// Returns a warning for each kind, with a count and the first place.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  friend void remark(const std::string& kind, const std::string& where);

  std::map<std::string, std::pair<std::string, int>> kinds_;  ///< The first place and the count.
  Remarks* outer_;
};

/// Adds to the innermost Remarks of this thread, if any.
void remark(const std::string& kind, const std::string& where);

/// Reads geometry_msgs/Point and Vector3, m. Coordinates that are missing in a map are 0.
[[nodiscard]] Eigen::Vector3d read_point(const geometric::YamlElement& element);

/// Reads geometry_msgs/Quaternion: x, y, z, w. As in MoveIt, an unset one, of zeros, is the
/// identity, and others are normalised, both with remarks.
[[nodiscard]] Eigen::Quaterniond read_rotation(const geometric::YamlElement& element);

/// Reads geometry_msgs/Pose: `position` and `orientation`, each of which may be missing.
[[nodiscard]] geometric::Pose read_pose(const geometric::YamlElement& element);

/// Reads sensor_msgs/JointState: positions by name, rad or m; none if `name` is missing.
/// @throws InputError if the numbers of positions and names differ.
[[nodiscard]] std::map<std::string, double> read_joint_state(const geometric::YamlElement& element);

/// Reads sensor_msgs/MultiDOFJointState: poses of planar and floating joints, by name.
/// @throws InputError if the numbers of transforms and names differ.
[[nodiscard]] std::map<std::string, geometric::Pose> read_multi_dof_joint_state(
    const geometric::YamlElement& element);

/// Reads geometry_msgs/Transform: `translation` and `rotation`, each of which may be missing.
[[nodiscard]] geometric::Pose read_transform(const geometric::YamlElement& element);

}  // namespace handway::import_moveit
