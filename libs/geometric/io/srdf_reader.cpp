#include "handway/geometric/io/srdf_reader.h"

#include "handway/geometric/io/input_error.h"
#include "io/number_text.h"
#include "io/srdf_groups.h"
#include "io/xml_document.h"

#include <algorithm>
#include <utility>

namespace handway::geometric {
namespace {

AllowedReason reason_of(const std::string& word) {
  for (const AllowedReason reason :
       {AllowedReason::kAdjacent, AllowedReason::kAlways, AllowedReason::kNever}) {
    if (word == to_string(reason)) {
      return reason;
    }
  }
  return AllowedReason::kUser;
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  std::transform(items.begin(), items.end(), std::back_inserter(names),
                 [](const auto& item) { return item.name; });
  return names;
}

NamedPosture posture_of(const XmlDocument& document, const pugi::xml_node& node,
                        const std::vector<JointGroup>& groups,
                        const std::vector<std::string>& joints) {
  NamedPosture posture{document.need(node, "name"), document.need(node, "group"), {}};
  if (std::ranges::count(groups, posture.group, &JointGroup::name) == 0) {
    refuse_unknown(document, node, "group", posture.group, names_of(groups));
  }
  for (const pugi::xml_node& joint : node.children("joint")) {
    const std::string name = document.need(joint, "name");
    if (std::ranges::count(joints, name) == 0) {
      refuse_unknown(document, joint, "joint", name, joints);
    }
    const std::string text = document.need(joint, "value");
    const std::optional<double> value = parse_number(text);
    if (!value) {
      throw InputError({document.where(joint), "joint " + name, "value \"" + text + "\"",
                        "one finite number (rad or m)", ""});
    }
    posture.values[name] = *value;
  }
  return posture;
}

AllowedCollisions allowed_of(const XmlDocument& document, const std::vector<std::string>& links) {
  AllowedCollisions allowed;
  for (const pugi::xml_node& node : document.root("robot").children("disable_collisions")) {
    const std::string a = document.need(node, "link1");
    const std::string b = document.need(node, "link2");
    for (const std::string& link : {a, b}) {
      if (std::ranges::count(links, link) == 0) {
        refuse_unknown(document, node, "link", link, links);
      }
    }
    allowed.allow(a, b, reason_of(node.attribute("reason").value()));
  }
  return allowed;
}

}  // namespace

void read_srdf(const std::filesystem::path& file, RobotDescription& robot) {
  const XmlDocument document(file, "a semantic robot file (SRDF)");
  const std::string name = document.root("robot").attribute("name").value();
  std::vector<JointGroup> groups = srdf_groups(document, robot);
  const std::vector<std::string> joints = names_of(robot.joints);
  std::vector<NamedPosture> postures;
  for (const pugi::xml_node& node : document.root("robot").children("group_state")) {
    postures.push_back(posture_of(document, node, groups, joints));
  }
  robot.allowed_collisions = allowed_of(document, names_of(robot.links));
  robot.groups = std::move(groups);
  robot.postures = std::move(postures);
  if (name != robot.name) {
    robot.warnings.push_back(file.string() + " is written for a robot called \"" + name + "\"");
  }
}

}  // namespace handway::geometric
