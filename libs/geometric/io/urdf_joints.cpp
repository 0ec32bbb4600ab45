#include "io/urdf_joints.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/base_joint.h"
#include "io/urdf_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace handway::geometric {
namespace {

JointLimits limits_of(const urdf::Joint& joint) {
  JointLimits limits;
  if (joint.limits) {
    limits.lower = joint.limits->lower;
    limits.upper = joint.limits->upper;
    limits.velocity = joint.limits->velocity > 0.0 ? joint.limits->velocity : limits.velocity;
  }
  if (joint.type == urdf::Joint::CONTINUOUS) {
    limits.lower = -std::numeric_limits<double>::infinity();
    limits.upper = std::numeric_limits<double>::infinity();
  }
  return limits;
}

bool is_base(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::PLANAR || joint.type == urdf::Joint::FLOATING;
}

void add_base(const urdf::Joint& joint, RobotDescription& robot) {
  const bool planar = joint.type == urdf::Joint::PLANAR;
  const Eigen::Vector3d normal(joint.axis.x, joint.axis.y, joint.axis.z);
  add_base_joint(robot, {joint.name, planar ? BaseMotion::kPlanar : BaseMotion::kFloating},
                 {joint.parent_link_name, joint.child_link_name,
                  pose_of(joint.parent_to_joint_origin_transform), normal.normalized()});
}

Joint joint_of(const urdf::Joint& joint) {
  Joint result;
  result.name = joint.name;
  result.parent = joint.parent_link_name;
  result.child = joint.child_link_name;
  result.X_PJ = pose_of(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::FIXED) {
    return result;
  }
  result.type = joint.type == urdf::Joint::PRISMATIC ? JointType::kPrismatic : JointType::kRevolute;
  result.axis = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  result.limits = limits_of(joint);
  if (joint.mimic) {
    result.mimic = Mimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
  }
  return result;
}

// Follows `mimic` to a joint that has none; q = m1 * (m2 * q2 + o2) + o1.
void resolve_mimic(Joint& joint, const std::vector<Joint>& joints, const std::string& where) {
  for (std::size_t steps = 0; joint.mimic; ++steps) {
    const auto leader = std::ranges::find(joints, joint.mimic->joint, &Joint::name);
    if (leader == joints.end() || !leader->mimic) {
      return;
    }
    if (steps > joints.size()) {
      throw InputError({where, "joint " + joint.name, "a mimic that leads back to itself",
                        "a joint that moves on its own", ""});
    }
    Mimic& mimic = *joint.mimic;
    mimic.offset += mimic.multiplier * leader->mimic->offset;
    mimic.multiplier *= leader->mimic->multiplier;
    mimic.joint = leader->mimic->joint;
  }
}

void note_joints(const std::vector<std::string>& names, const char* what, RobotDescription& robot) {
  if (!names.empty()) {
    robot.warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
  }
}

}  // namespace

void add_joints(const XmlDocument& document, const urdf::ModelInterface& model,
                RobotDescription& robot) {
  std::vector<std::string> places;
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    places.push_back(document.where(node));
    const std::string name = node.attribute("name").value();
    const urdf::JointConstSharedPtr joint = model.getJoint(name);
    if (!joint) {
      throw InputError({places.back(), "joint " + name, "a joint that urdfdom does not read",
                        "what ROS reads too", ""});
    }
    if (is_base(*joint)) {
      add_base(*joint, robot);
      places.resize(robot.joints.size(), places.back());
    } else {
      robot.joints.push_back(joint_of(*joint));
    }
  }
  const std::vector<Joint> as_written = robot.joints;
  std::vector<std::string> rangeless;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    Joint& joint = robot.joints[i];
    resolve_mimic(joint, as_written, places[i]);
    if (joint.type != JointType::kFixed && joint.limits.range() == 0.0) {
      rangeless.push_back(joint.name);
    }
  }
  note_joints(rangeless, "joints that can't move, as their limits leave no range", robot);
}

}  // namespace handway::geometric
