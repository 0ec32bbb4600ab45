#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <string>

/// The robots of the paper in code: kinematics and limits without meshes, so
/// that tests of the mathematics need no file.
namespace handway::test {

/// The arm as its maker's URDF writes it: joint frames parallel to the base at
/// zero, links "base_link", "link_1" to "link_6" and the fixed "flange",
/// joints "joint_1" to "joint_6".
[[nodiscard]] geometric::RobotDescription tx90_urdf_style();

/// Returns this arm in modified Denavit-Hartenberg form, every axis being z, as the `.rob` files
/// write it: links "Base", "Shoulder", "ForeArm", "Elbow", "Arm", "Wrist", "Tcp", joints of the
/// links' names.
[[nodiscard]] geometric::RobotDescription tx90_dh_style();

/// Adds the right SAH hand (four fingers, 13 variables, distal joints coupled
/// to the medial ones) with a link "Palm" fixed to `mount`, joints named after
/// the links ("Thumb", "Thumb-Base", "Index-Base", … "Ring-Dist").
void add_sah_hand(geometric::RobotDescription& robot, const std::string& mount);

/// tx90_urdf_style with the hand: 25 links, 19 variables.
[[nodiscard]] geometric::RobotDescription tx90_sah();

/// A joint that turns about z, with limits in rad.
[[nodiscard]] geometric::Joint turning(const std::string& name, const std::string& parent,
                                       const std::string& child, double lower = -1.0,
                                       double upper = 1.0);

/// Arms of other makers from their published modified Denavit-Hartenberg parameters and limits:
/// links "base", "link_1" and so on, the last with the flange's frame, joints "joint_1" and so on.
/// Six joints with an offset wrist that turn a whole turn each way; seven with offsets at elbow and
/// wrist; seven with a shoulder, an elbow and a wrist in line.
[[nodiscard]] geometric::RobotDescription ur5e();
[[nodiscard]] geometric::RobotDescription panda_arm();
[[nodiscard]] geometric::RobotDescription iiwa14();

}  // namespace handway::test
