#include "handway/geometric/formats/srdf_writer.h"

#include "formats/xml_document.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"

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
  while (const pugi::xml_node element = robot.child("disable_collisions")) {
    robot.remove_child(element);
  }
}

void append_group(pugi::xml_node robot, const JointGroup& group) {
  pugi::xml_node element = robot.append_child("group");
  element.append_attribute("name") = group.name.c_str();
  for (const std::string& joint : group.joints) {
    element.append_child("joint").append_attribute("name") = joint.c_str();
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

}  // namespace

void write_disabled_collisions(const std::filesystem::path& file, const std::string& robot,
                               const AllowedCollisions& allowed) {
  if (std::filesystem::exists(file)) {
    XmlDocument document(file, "a semantic robot file (SRDF)");
    pugi::xml_node root = document.root("robot");
    remove_disabled(root);
    append_disabled(root, allowed);
    replace_file(file, xml_text(document.nodes()));
    return;
  }
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("robot");
  root.append_attribute("name") = robot.c_str();
  append_disabled(root, allowed);
  replace_file(file, xml_text(document));
}

void write_srdf(const RobotDescription& robot, const std::filesystem::path& file) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("robot");
  root.append_attribute("name") = robot.name.c_str();
  for (const JointGroup& group : robot.groups) {
    append_group(root, group);
  }
  for (const NamedPosture& posture : robot.postures) {
    append_posture(root, posture);
  }
  append_disabled(root, robot.allowed_collisions);
  replace_file(file, xml_text(document));
}

}  // namespace handway::geometric
