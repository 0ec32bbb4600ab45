#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Default range of a base each way if neither its file nor a scene gives one, m.
inline constexpr double kDefaultBaseReach = 2.0;

/// Place of a base joint, as Joint::parent, Joint::child and Joint::X_PJ.
struct BasePlace {
  std::string parent;
  std::string child;
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Plane's normal, in the joint's frame.
};

/// Appends a planar or floating joint as a chain of slides and rotations, connected by links
/// without shape with the joints' names:
/// - planar: NAME/x, NAME/y, and NAME/theta about the normal, as MoveIt calls them;
/// - floating: NAME/trans_x, NAME/trans_y, NAME/trans_z, as MoveIt calls them, then NAME/yaw
///   about z, NAME/pitch about the new y and NAME/roll about the newest x: the angles of URDF's
///   `rpy`. So every orientation is reached; next to a pitch of ±90°, yaw and roll are equivalent.
///
/// All rotations are continuous but the pitch, which has ±90°. Slides have ±kDefaultBaseReach.
HANDWAY_GEOMETRIC_EXPORT void add_base_joint(RobotDescription& robot, const BaseJoint& base,
                                             const BasePlace& place);

/// The joints of its chain, in order: the slides first.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> joints_of(const BaseJoint& base);
/// The slides alone.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> slides_of(const BaseJoint& base);

/// Values of joints_of() for a pose of the child in the joint's frame; a planar joint takes the
/// nearest pose.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<double> values_at(const BaseJoint& base,
                                                                     const Pose& X_JC);

/// Makes the robot's root move, too: adds a new root "world" (or "world_2", if taken) and the joint
/// in between. Its joints go to the front of the group "arm", if any.
HANDWAY_GEOMETRIC_EXPORT void add_moving_root(RobotDescription& robot, const BaseJoint& base,
                                              const std::string& root, std::string_view frame);

}  // namespace handway::geometric
