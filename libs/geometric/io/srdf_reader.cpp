#include "handway/geometric/io/srdf_reader.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/base_joint.h"
#include "io/number_text.h"
#include "io/srdf_groups.h"
#include "io/xml_document.h"
#include "io/xml_vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
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

// http://wiki.ros.org/srdf; only the first three and virtual_joint are read.
const XmlVocabulary& vocabulary() {
  static const XmlVocabulary kVocabulary = {
      {"robot",
       {.children = {"group", "group_state", "disable_collisions", "end_effector", "virtual_joint",
                     "passive_joint", "joint_property", "link_sphere_approximation"}}},
      {"group", {.children = {"joint", "link", "chain", "group"}}},
      {"chain", {.attributes = {"base_link", "tip_link"}}},
      {"group_state", {.children = {"joint"}}},
      {"disable_collisions", {.attributes = {"link1", "link2", "reason"}}}};
  return kVocabulary;
}

// The planar and floating ones, by which MoveIt lets the root move. Those that a group names become
// joints of the robot.
void add_virtual_joints(const XmlDocument& document, RobotDescription& robot) {
  const pugi::xml_node top = document.root("robot");
  const auto is_root = [&](const std::string& link) {
    return std::ranges::count(robot.joints, link, &Joint::child) == 0;
  };
  for (const pugi::xml_node& node : top.children("virtual_joint")) {
    const std::string type = document.need(node, "type");
    const std::string child = document.need(node, "child_link");
    if ((type != "planar" && type != "floating") || !is_root(child)) {
      continue;
    }
    const BaseJoint joint{document.need(node, "name"),
                          type == "planar" ? BaseMotion::kPlanar : BaseMotion::kFloating};
    const auto names_it = [&](const pugi::xml_node& group) {
      const auto parts = group.children("joint");
      return std::any_of(parts.begin(), parts.end(), [&](const pugi::xml_node& part) {
        return part.attribute("name").value() == joint.name;
      });
    };
    const auto groups = top.children("group");
    if (std::any_of(groups.begin(), groups.end(), names_it)) {
      add_moving_root(robot, joint, child, node.attribute("parent_frame").value());
    } else {
      robot.virtual_joints.push_back(joint);
    }
  }
}

/// What is read of an SRDF file.
struct Semantics {
  std::vector<JointGroup> groups;
  std::vector<NamedPosture> postures;
  AllowedCollisions allowed;
  std::vector<std::string> warnings;
};

class SrdfReader {
 public:
  SrdfReader(const XmlDocument& document, const RobotDescription& robot)
      : document_(document),
        top_(document.root("robot")),
        links_(names_of(robot.links)),
        joints_(names_of(robot.joints)) {
    semantics_.groups = srdf_groups(document, robot, unknown_);
  }

  [[nodiscard]] Semantics read() {
    for (const pugi::xml_node& node : top_.children("group_state")) {
      add_posture(node);
    }
    for (const pugi::xml_node& node : top_.children("disable_collisions")) {
      add_allowed(node);
    }
    const auto unread =
        unread_elements(document_, top_, vocabulary(), {"group", "chain", "disable_collisions"});
    if (!unread.empty()) {
      semantics_.warnings.push_back(
          fmt::format("elements of the SRDF that are not read: {}", fmt::join(unread, ", ")));
    }
    if (const std::string names = unknown_.summary(); !names.empty()) {
      semantics_.warnings.push_back(names);
    }
    return std::move(semantics_);
  }

 private:
  void add_posture(const pugi::xml_node& node) {
    NamedPosture posture{document_.need(node, "name"), document_.need(node, "group"), {}};
    if (!unknown_.check(document_, node, "group", posture.group, names_of(semantics_.groups))) {
      return;
    }
    for (const pugi::xml_node& joint : node.children("joint")) {
      const std::string name = document_.need(joint, "name");
      const std::string text = document_.need(joint, "value");
      const std::optional<double> value = parse_number(text);
      if (!value) {
        throw InputError({document_.where(joint), "joint " + name, "value \"" + text + "\"",
                          "one finite number (rad or m)", ""});
      }
      if (unknown_.check(document_, joint, "joint", name, joints_)) {
        posture.values[name] = *value;
      }
    }
    semantics_.postures.push_back(std::move(posture));
  }

  void add_allowed(const pugi::xml_node& node) {
    const std::string a = document_.need(node, "link1");
    const std::string b = document_.need(node, "link2");
    const auto is_known = [&](const std::string& link) {
      return unknown_.check(document_, node, "link", link, links_);
    };
    if (is_known(a) && is_known(b)) {
      semantics_.allowed.allow(a, b, reason_of(node.attribute("reason").value()));
    }
  }

  const XmlDocument& document_;
  pugi::xml_node top_;
  std::vector<std::string> links_;
  std::vector<std::string> joints_;
  UnknownNames unknown_;
  Semantics semantics_;
};

}  // namespace

void read_srdf(const std::filesystem::path& file, RobotDescription& robot) {
  const XmlDocument document(file, "a semantic robot file (SRDF)");
  add_virtual_joints(document, robot);
  Semantics srdf = SrdfReader(document, robot).read();
  if (const std::string name = document.root("robot").attribute("name").value();
      name != robot.name) {
    srdf.warnings.push_back(file.string() + " is written for a robot called \"" + name + "\"");
  }
  robot.groups = std::move(srdf.groups);
  robot.postures = std::move(srdf.postures);
  robot.allowed_collisions = std::move(srdf.allowed);
  std::ranges::move(srdf.warnings, std::back_inserter(robot.warnings));
}

}  // namespace handway::geometric
