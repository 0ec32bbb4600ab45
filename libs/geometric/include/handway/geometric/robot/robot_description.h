#pragma once

#include "handway/geometric/robot/allowed_collisions.h"
#include "handway/geometric/robot/joint.h"
#include "handway/geometric/robot/link.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace handway::geometric {

/// A named set of joints, for example "arm" or "hand" (SRDF's `group`).
struct JointGroup {
  std::string name;
  std::vector<std::string> joints;
};

/// A named posture of some joints (SRDF's `group_state`), rad or m.
struct NamedPosture {
  std::string name;
  std::string group;
  std::map<std::string, double> values;
};

enum class BaseMotion { kPlanar, kFloating };

/// A planar or floating joint, which is a chain of slides and turns: see add_base_joint().
struct BaseJoint {
  std::string name;
  BaseMotion motion = BaseMotion::kPlanar;
  /// It was added because a scene lets the robot's root move; the robot's file has it not.
  bool of_scene = false;
};

/// What a robot file says, before it is checked: the input of RobotModel.
struct RobotDescription {
  std::string name;
  std::filesystem::path file;  ///< For messages; may be empty.
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<JointGroup> groups;
  std::vector<BaseJoint> base_joints;
  std::vector<BaseJoint> virtual_joints;  ///< Of the SRDF; they don't move unless a scene says so.
  std::vector<NamedPosture> postures;
  AllowedCollisions allowed_collisions;
  std::vector<std::string> warnings;  ///< What the reader noticed but could live with.
};

}  // namespace handway::geometric
