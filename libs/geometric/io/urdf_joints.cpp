#include "io/urdf_joints.h"

#include "handway/geometric/io/input_error.h"
#include "io/urdf_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

namespace handway::geometric {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Eigen::Vector3d unit_axis(const urdf::Joint& joint, const std::string& where) {
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (!axis.allFinite() || axis.norm() < 1e-9) {
    throw InputError({where, "joint " + joint.name, "an axis without direction",
                      "an axis such as \"0 0 1\"", ""});
  }
  return axis.normalized();
}

JointLimits limits_of(const urdf::Joint& joint, RobotDescription& robot) {
  JointLimits limits;
  if (joint.limits) {
    limits.lower = joint.limits->lower;
    limits.upper = joint.limits->upper;
    limits.velocity = joint.limits->velocity > 0.0 ? joint.limits->velocity : limits.velocity;
  }
  if (joint.type == urdf::Joint::CONTINUOUS) {
    limits.lower = -kTurn;
    limits.upper = kTurn;
    robot.warnings.push_back("joint " + joint.name +
                             " turns without end; it is limited to one turn each way");
  }
  return limits;
}

Joint joint_of(const urdf::Joint& joint, const std::string& where, RobotDescription& robot) {
  Joint result;
  result.name = joint.name;
  result.parent = joint.parent_link_name;
  result.child = joint.child_link_name;
  result.X_PJ = pose_of(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::FIXED) {
    return result;
  }
  result.type = joint.type == urdf::Joint::PRISMATIC ? JointType::kPrismatic : JointType::kRevolute;
  result.axis = unit_axis(joint, where);
  result.limits = limits_of(joint, robot);
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

void check_joint_element(const XmlDocument& document, const pugi::xml_node& joint) {
  const std::string element = "joint " + document.need(joint, "name");
  const std::string type = document.need(joint, "type");
  if (type == "floating" || type == "planar") {
    throw InputError({document.where(joint), element, "type \"" + type + "\"",
                      "revolute, continuous, prismatic or fixed",
                      "Model it by prismatic and revolute joints with small links between"});
  }
  if (type != "revolute" && type != "continuous" && type != "prismatic" && type != "fixed") {
    throw InputError({document.where(joint), element, "type \"" + type + "\"",
                      "revolute, continuous, prismatic or fixed", ""});
  }
  for (const char* end : {"parent", "child"}) {
    if (!joint.child(end)) {
      throw InputError({document.where(joint), element, std::string("no <") + end + ">",
                        std::string("<") + end + " link=\"…\"/>", ""});
    }
    static_cast<void>(document.need(joint.child(end), "link"));
  }
  if ((type == "revolute" || type == "prismatic") && !joint.child("limit")) {
    throw InputError({document.where(joint), element, "no <limit>",
                      "<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>",
                      "A joint that turns without end is of type continuous"});
  }
}

}  // namespace

void check_joint_elements(const XmlDocument& document) {
  for (const pugi::xml_node& joint : document.root("robot").children("joint")) {
    check_joint_element(document, joint);
  }
}

void add_joints(const XmlDocument& document, const urdf::ModelInterface& model,
                RobotDescription& robot) {
  std::vector<std::string> places;
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    const urdf::JointConstSharedPtr joint = model.getJoint(node.attribute("name").value());
    if (joint) {
      places.push_back(document.where(node));
      robot.joints.push_back(joint_of(*joint, places.back(), robot));
    }
  }
  const std::vector<Joint> as_written = robot.joints;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    resolve_mimic(robot.joints[i], as_written, places[i]);
  }
}

}  // namespace handway::geometric
