#include "formats/xml_document.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/robot/robot_description.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

void append_disabled(pugi::xml_node robot, const AllowedCollisions& allowed) {
  for (const auto& [pair, reason] : allowed.entries()) {
    pugi::xml_node element = robot.append_child("disable_collisions");
    element.append_attribute("link1") = pair.first.c_str();
    element.append_attribute("link2") = pair.second.c_str();
    element.append_attribute("reason") = to_string(reason);
  }
}

void remove_disabled(pugi::xml_node robot) {
  for (const char* kind :
       {"disable_collisions", "disable_default_collisions", "enable_collisions"}) {
    while (robot.remove_child(kind)) {
    }
  }
}

bool has_child(const pugi::xml_node& robot, const char* element, const std::string& name) {
  return !robot.find_child_by_attribute(element, "name", name.c_str()).empty();
}

void append_joints(pugi::xml_node group, const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) {
    group.append_child("joint").append_attribute("name") = joint.c_str();
  }
}

void append_group(pugi::xml_node robot, const JointGroup& group) {
  pugi::xml_node element = robot.append_child("group");
  element.append_attribute("name") = group.name.c_str();
  append_joints(element, group.joints);
}

void append_end_effector(pugi::xml_node robot, const EndEffector& effector) {
  pugi::xml_node element = robot.append_child("end_effector");
  element.append_attribute("name") = effector.name.c_str();
  element.append_attribute("parent_link") = effector.parent_link.c_str();
  element.append_attribute("group") = effector.group.c_str();
  if (!effector.parent_group.empty()) {
    element.append_attribute("parent_group") = effector.parent_group.c_str();
  }
}

void append_posture(pugi::xml_node robot, const NamedPosture& posture) {
  pugi::xml_node element = robot.append_child("group_state");
  element.append_attribute("name") = posture.name.c_str();
  element.append_attribute("group") = posture.group.c_str();
  for (const auto& [joint, value] : posture.values) {
    pugi::xml_node child = element.append_child("joint");
    child.append_attribute("name") = joint.c_str();
    child.append_attribute("value") = number_text(value).c_str();
  }
}

void remove_if(pugi::xml_node robot, const char* element, const auto& condition) {
  for (pugi::xml_node child = robot.child(element); child;) {
    const pugi::xml_node next = child.next_sibling(element);
    if (condition(child)) {
      robot.remove_child(child);
    }
    child = next;
  }
}

// Replaced in place, since other groups may name it.
void replace_group(pugi::xml_node root, const RobotDescription& robot, const std::string& name) {
  pugi::xml_node element = root.find_child_by_attribute("group", "name", name.c_str());
  const auto group = std::ranges::find(robot.groups, name, &JointGroup::name);
  if (group != robot.groups.end()) {
    element.remove_children();
    append_joints(element, group->joints);
    return;
  }
  root.remove_child(element);
  remove_if(root, "group_state", [&](const pugi::xml_node& posture) {
    return posture.attribute("group").value() == name;
  });
}

}  // namespace

void update_srdf(const RobotDescription& robot, const std::filesystem::path& file,
                 const std::vector<std::string>& decided) {
  if (!std::filesystem::exists(file)) {
    write_srdf(robot, file);
    return;
  }
  XmlDocument document(file, "a semantic robot file (SRDF)");
  pugi::xml_node root = document.root("robot");
  for (const std::string& group : decided) {
    replace_group(root, robot, group);
  }
  if (!decided.empty()) {
    remove_if(root, "end_effector", [&](const pugi::xml_node& element) {
      return std::ranges::find(robot.end_effectors, element.attribute("name").value(),
                               &EndEffector::name) == robot.end_effectors.end();
    });
  }
  for (const JointGroup& group : robot.groups) {
    if (!has_child(root, "group", group.name)) {
      append_group(root, group);
    }
  }
  for (const EndEffector& effector : robot.end_effectors) {
    if (!has_child(root, "end_effector", effector.name)) {
      append_end_effector(root, effector);
    }
  }
  remove_disabled(root);
  append_disabled(root, robot.allowed_collisions);
  replace_file(file, xml_text(document.nodes()));
}

void write_srdf(const RobotDescription& robot, const std::filesystem::path& file) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("robot");
  root.append_attribute("name") = robot.name.c_str();
  for (const JointGroup& group : robot.groups) {
    append_group(root, group);
  }
  for (const EndEffector& effector : robot.end_effectors) {
    append_end_effector(root, effector);
  }
  for (const NamedPosture& posture : robot.postures) {
    append_posture(root, posture);
  }
  append_disabled(root, robot.allowed_collisions);
  replace_file(file, xml_text(document));
}

}  // namespace handway::geometric
