#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"

#include <Eigen/Core>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Motion that a joint allows.
enum class JointType { kFixed, kRevolute, kPrismatic };

/// Limits of a joint: rad, rad/s, rad/s² (revolute) or m, m/s, m/s² (prismatic). Those of a
/// continuous joint, a revolute one that turns without end, are infinite.
struct JointLimits {
  double lower = 0.0;
  double upper = 0.0;
  double velocity = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();

  [[nodiscard]] double range() const { return upper - lower; }
};

/// Linear coupling: q = multiplier * q_of(joint) + offset (URDF's `mimic`).
struct Mimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
};

/// Connects a child link to its parent. With P the parent's frame and J the
/// joint's own, X_PJ is fixed and the child moves by q about (revolute) or
/// along (prismatic) `axis`, a unit vector in J.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;  ///< Link name.
  std::string child;   ///< Link name.
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  JointLimits limits;
  std::optional<Mimic> mimic;

  /// Returns whether the joint is revolute without ends: its values repeat after a whole turn.
  [[nodiscard]] bool is_continuous() const {
    return type == JointType::kRevolute && std::isinf(limits.lower) && std::isinf(limits.upper);
  }
};

/// One shape fixed to a link; X_LG is the shape's frame in the link's.
struct LinkGeometry {
  Shape shape;
  Pose X_LG = Pose::Identity();
  Color color;
};

/// A rigid body of a robot. Visual and collision geometry may differ.
struct Link {
  std::string name;
  std::vector<LinkGeometry> visual;
  std::vector<LinkGeometry> collision;
};

/// Reason why a pair of links need not be checked against each other.
enum class AllowedReason {
  kAdjacent,  ///< Joined by a joint: they touch by construction.
  kAlways,    ///< In collision in every sampled configuration.
  kNever,     ///< In collision in no sampled configuration.
  kDefault,   ///< In collision at the neutral posture and at most others: the shapes overlap.
  kUser,      ///< Set by the user.
};

/// The word in SRDF files: "Adjacent", "Always", "Never", "Default", "User".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const char* to_string(AllowedReason reason);

/// The allowed-collision matrix: pairs of link names with the reason. The order
/// of a pair's names does not matter.
class HANDWAY_GEOMETRIC_EXPORT AllowedCollisions {
 public:
  using Pair = std::pair<std::string, std::string>;  ///< Names in ascending order.

  void allow(const std::string& link_a, const std::string& link_b, AllowedReason reason);
  void forbid(const std::string& link_a, const std::string& link_b);

  [[nodiscard]] std::optional<AllowedReason> reason(const std::string& link_a,
                                                    const std::string& link_b) const;
  [[nodiscard]] const std::map<Pair, AllowedReason>& entries() const { return entries_; }

 private:
  std::map<Pair, AllowedReason> entries_;
};

/// A named set of joints, for example "arm" or "hand" (SRDF's `group`).
struct JointGroup {
  std::string name;
  std::vector<std::string> joints;
};

/// Link that an arm carries to work with (SRDF's `end_effector`).
struct EndEffector {
  std::string name;
  std::string group;         ///< Its joints.
  std::string parent_link;   ///< The link that carries it.
  std::string parent_group;  ///< The joints that move it; may be empty.

  friend bool operator==(const EndEffector&, const EndEffector&) = default;
};

/// A named posture of some joints (SRDF's `group_state`), rad or m.
struct NamedPosture {
  std::string name;
  std::string group;
  std::map<std::string, double> values;
};

/// Motion that a base joint allows.
enum class BaseMotion { kPlanar, kFloating };

/// A planar or floating joint, which is a chain of slides and rotations: see add_base_joint().
struct BaseJoint {
  std::string name;
  BaseMotion motion = BaseMotion::kPlanar;
  /// Added because a scene lets the robot's root move; missing in the robot's file.
  bool of_scene = false;
};

/// A joint that follows several others: q = offset + Σ multiplier * q_of(joint).
struct JointCoupling {
  std::string joint;
  std::vector<std::pair<std::string, double>> terms;  ///< Joints, each once, and multipliers.
  double offset = 0.0;                                ///< rad or m
  bool of_scene = false;                              ///< From a scene, not from the robot's files.
};

/// Values of arguments of a xacro file, by the arguments' names.
using XacroArguments = std::map<std::string, std::string>;

/// Contents of a robot file before they are checked: the input of RobotModel.
struct RobotDescription {
  std::string name;
  std::filesystem::path file;      ///< For messages; may be empty.
  XacroArguments xacro_arguments;  ///< Arguments that the file was expanded with, if it is xacro.
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<JointGroup> groups;
  std::vector<EndEffector> end_effectors;
  std::vector<BaseJoint> base_joints;
  std::vector<BaseJoint> virtual_joints;  ///< From the SRDF; fixed unless a scene frees them.
  std::vector<JointCoupling> couplings;   ///< Made by couple_joint().
  std::vector<NamedPosture> postures;
  AllowedCollisions allowed_collisions;
  std::vector<std::string> warnings;  ///< Warnings of the reader.
};

/// Narrows the limits of a joint of `robot` by those in `source`. Limits that leave the
/// joint no range, or give a joint without ends only one, are ignored with a warning of the
/// robot.
/// @param lower, upper rad or m; nothing: not limited there.
HANDWAY_GEOMETRIC_EXPORT void narrow_limits(RobotDescription& robot, Joint& joint,
                                            std::optional<double> lower,
                                            std::optional<double> upper, const std::string& source);

/// Couples a joint to several others. It becomes a chain of joints about or along the same axis,
/// one for each term, each of which follows one joint: the values of such a chain add up. All but
/// the last, JOINT/1, JOINT/2, …, carry links of their names without shape; the last keeps name and
/// link.
///
/// The joint keeps its limits: if the sum could leave them, the ranges of the joints that it
/// follows are narrowed towards their neutral values by one share, which keeps the sum within for
/// any of their values, with a warning.
/// @param source, element of the coupling, for messages.
/// @throws InputError if a joint is missing, fixed, of another kind or a follower, the coupling
/// names the joint itself, or the limits are never kept at the neutral values.
HANDWAY_GEOMETRIC_EXPORT void couple_joint(RobotDescription& robot, const JointCoupling& coupling,
                                           const std::string& source, const std::string& element);

/// The mirror image of a robot, in the plane y = 0 of its root link: a left hand from a right one,
/// or the reverse. Every posture of it is the mirror image of the same posture of `robot`, joint
/// by joint. Names stay, so that postures, mappings and hand bases of one fit the other; but
/// "right" in the robot's own name becomes "left" and "left" "right", or it gets the suffix
/// "_mirrored".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription mirrored(RobotDescription robot);

}  // namespace handway::geometric
