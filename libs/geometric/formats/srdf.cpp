#include "handway/geometric/formats/srdf.h"

#include "formats/xml_document.h"
#include "formats/xml_vocabulary.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/robot_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr const char* kWhat = "a semantic robot file (SRDF)";

/// Lines of an SRDF file about unknown links, joints or groups: mostly those of another variant of
/// the robot. They are skipped, and reported in one warning.
class UnknownNames {
 public:
  void add(const XmlDocument& document, const pugi::xml_node& node, const std::string& kind,
           const std::string& name, const std::vector<std::string>& known);
  /// Returns whether `name` is known; records it if it is not.
  bool check(const XmlDocument& document, const pugi::xml_node& node, const std::string& kind,
             const std::string& name, const std::vector<std::string>& known);

  /// Text "2 lines of the SRDF about …: FILE:LINE: link "x" ("y"?); …"; empty without any.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> lines_;
};

class GroupReader {
 public:
  GroupReader(const XmlDocument& document, const RobotDescription& robot, UnknownNames& unknown)
      : document_(document), robot_(robot), unknown_(unknown) {
    for (const Link& link : robot.links) {
      link_names_.push_back(link.name);
    }
    for (const Joint& joint : robot.joints) {
      joint_names_.push_back(joint.name);
    }
  }

  [[nodiscard]] std::vector<JointGroup> read() {
    std::vector<JointGroup> groups;
    for (const pugi::xml_node& node : document_.root("robot").children("group")) {
      JointGroup group{document_.need(node, "name"), {}};
      if (std::ranges::count(groups, group.name, &JointGroup::name) > 0) {
        throw InputError({document_.where(node), "group " + group.name, "two groups of this name",
                          "unique names", ""});
      }
      add_group(node, group.joints, 0);
      groups.push_back(std::move(group));
    }
    return groups;
  }

 private:
  void add_group(const pugi::xml_node& group, std::vector<std::string>& joints, int depth) {
    if (depth > 50) {
      throw InputError({document_.where(group),
                        "group " + std::string(group.attribute("name").value()),
                        "a group that contains itself", "groups without a ring", ""});
    }
    for (const pugi::xml_node& part : group.children()) {
      const std::string kind = part.name();
      if (kind == "joint") {
        if (const BaseJoint* base = base_called(part.attribute("name").value())) {
          for (const std::string& joint : joints_of(*base)) {
            add(joints, joint);
          }
        } else if (const auto joint = known(part, "joint", "name", joint_names_)) {
          add(joints, *joint);
        }
      } else if (kind == "link") {
        if (const auto link = known(part, "link", "name", link_names_)) {
          add_carrier(joints, *link);
        }
      } else if (kind == "chain") {
        add_chain(part, joints);
      } else if (kind == "group") {
        add_group(subgroup(part), joints, depth + 1);
      }
    }
  }

  void add_chain(const pugi::xml_node& chain, std::vector<std::string>& joints) {
    const auto base = known(chain, "link", "base_link", link_names_);
    const auto tip = known(chain, "link", "tip_link", link_names_);
    if (!base || !tip) {
      return;
    }
    std::vector<std::string> upwards;
    for (std::string link = *tip; link != *base;) {
      const Joint* carrier = carrier_of(link);
      if (!carrier || upwards.size() > robot_.joints.size()) {
        throw InputError({document_.where(chain), "chain", "\"" + *base + "\" to \"" + *tip + "\"",
                          "a base_link above the tip_link", ""});
      }
      upwards.push_back(carrier->name);
      link = carrier->parent;
    }
    for (auto joint = upwards.rbegin(); joint != upwards.rend(); ++joint) {
      add(joints, *joint);
    }
  }

  void add_carrier(std::vector<std::string>& joints, const std::string& link) {
    if (const Joint* carrier = carrier_of(link)) {
      add(joints, carrier->name);
    }
  }

  static void add(std::vector<std::string>& joints, const std::string& joint) {
    if (std::ranges::count(joints, joint) == 0) {
      joints.push_back(joint);
    }
  }

  [[nodiscard]] const BaseJoint* base_called(const std::string& name) const {
    const auto base = std::ranges::find(robot_.base_joints, name, &BaseJoint::name);
    return base == robot_.base_joints.end() ? nullptr : &*base;
  }

  [[nodiscard]] const Joint* carrier_of(const std::string& link) const {
    const auto carrier = std::ranges::find(robot_.joints, link, &Joint::child);
    return carrier == robot_.joints.end() ? nullptr : &*carrier;
  }

  // Returns the subgroup's node; an empty node if it is missing.
  [[nodiscard]] pugi::xml_node subgroup(const pugi::xml_node& part) const {
    const std::string name = document_.need(part, "name");
    std::vector<std::string> names;
    for (const pugi::xml_node& group : document_.root("robot").children("group")) {
      if (name == group.attribute("name").value()) {
        return group;
      }
      names.emplace_back(group.attribute("name").value());
    }
    unknown_.add(document_, part, "group", name, names);
    return {};
  }

  // Returns the value of `attribute` if the robot has that name.
  [[nodiscard]] std::optional<std::string> known(const pugi::xml_node& node,
                                                 const std::string& kind, const char* attribute,
                                                 const std::vector<std::string>& names) const {
    const std::string name = document_.need(node, attribute);
    return unknown_.check(document_, node, kind, name, names) ? std::optional(name) : std::nullopt;
  }

  const XmlDocument& document_;
  const RobotDescription& robot_;
  UnknownNames& unknown_;
  std::vector<std::string> link_names_;
  std::vector<std::string> joint_names_;
};

void UnknownNames::add(const XmlDocument& document, const pugi::xml_node& node,
                       const std::string& kind, const std::string& name,
                       const std::vector<std::string>& known) {
  const std::string advice = nearest_name(name, known);
  lines_.push_back(fmt::format("{}: {} \"{}\"{}", document.where(node), kind, name,
                               advice.empty() ? "" : fmt::format(" (\"{}\"?)", advice)));
}

bool UnknownNames::check(const XmlDocument& document, const pugi::xml_node& node,
                         const std::string& kind, const std::string& name,
                         const std::vector<std::string>& known) {
  const bool is_known = std::ranges::count(known, name) > 0;
  if (!is_known) {
    add(document, node, kind, name, known);
  }
  return is_known;
}

std::string UnknownNames::summary() const {
  constexpr std::size_t kMostNamed = 3;
  if (lines_.empty()) {
    return "";
  }
  std::string text = fmt::format(
      "{} line{} of the SRDF about what the robot has not {} passed over: ", lines_.size(),
      lines_.size() == 1 ? "" : "s", lines_.size() == 1 ? "is" : "are");
  const std::size_t named = std::min(kMostNamed, lines_.size());
  for (std::size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : "; ") + lines_[i];
  }
  if (lines_.size() > named) {
    text += fmt::format("; and {} more", lines_.size() - named);
  }
  return text;
}

/// The groups of an SRDF document with all their joints, in the order of the file.
/// @throws InputError naming the line of an invalid chain or of a ring.
std::vector<JointGroup> srdf_groups(const XmlDocument& document, const RobotDescription& robot,
                                    UnknownNames& unknown) {
  return GroupReader(document, robot, unknown).read();
}

AllowedReason reason_of(const std::string& word) {
  for (const AllowedReason reason : {AllowedReason::kAdjacent, AllowedReason::kAlways,
                                     AllowedReason::kNever, AllowedReason::kDefault}) {
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

// http://wiki.ros.org/srdf; only the first four and virtual_joint are read.
const XmlVocabulary& vocabulary() {
  static const XmlVocabulary kVocabulary = {
      {"robot",
       {.children = {"group", "group_state", "disable_collisions", "disable_default_collisions",
                     "enable_collisions", "end_effector", "virtual_joint", "coupling",
                     "passive_joint", "joint_property", "link_sphere_approximation"}}},
      {"group", {.children = {"joint", "link", "chain", "group"}}},
      {"chain", {.attributes = {"base_link", "tip_link"}}},
      {"group_state", {.children = {"joint"}}},
      {"end_effector", {.attributes = {"name", "parent_link", "group", "parent_group"}}},
      {"coupling", {.children = {"follows"}, .attributes = {"joint", "offset"}}},
      {"follows", {.attributes = {"joint", "multiplier"}}},
      {"disable_collisions", {.attributes = {"link1", "link2", "reason"}}}};
  return kVocabulary;
}

// Adds planar and floating joints, by which MoveIt lets the root move. Those that a group names
// become joints of the robot.
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

/// Contents of an SRDF file.
struct Semantics {
  std::vector<JointGroup> groups;
  std::vector<EndEffector> end_effectors;
  std::vector<NamedPosture> postures;
  AllowedCollisions allowed;
  std::vector<std::string> warnings;
};

class SrdfReader {
 public:
  SrdfReader(const XmlDocument& document, const RobotDescription& robot)
      : document_(document),
        top_(document.root("robot")),
        robot_(robot),
        links_(names_of(robot.links)),
        joints_(names_of(robot.joints)) {
    semantics_.groups = srdf_groups(document, robot, unknown_);
  }

  [[nodiscard]] Semantics read() {
    for (const pugi::xml_node& node : top_.children("end_effector")) {
      add_end_effector(node);
    }
    for (const pugi::xml_node& node : top_.children("group_state")) {
      add_posture(node);
    }
    for (const pugi::xml_node& node : top_.children("disable_default_collisions")) {
      allow_all_of(node);
    }
    for (const pugi::xml_node& node : top_.children("enable_collisions")) {
      semantics_.allowed.forbid(document_.need(node, "link1"), document_.need(node, "link2"));
    }
    for (const pugi::xml_node& node : top_.children("disable_collisions")) {
      add_allowed(node);
    }
    note_passive_joints();
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
  void add_end_effector(const pugi::xml_node& node) {
    const EndEffector effector{node.attribute("name").value(), node.attribute("group").value(),
                               node.attribute("parent_link").value(),
                               node.attribute("parent_group").value()};
    const std::vector<std::string> groups = names_of(semantics_.groups);
    const auto is_group = [&](const std::string& group) {
      return unknown_.check(document_, node, "group", group, groups);
    };
    if (is_group(effector.group) &&
        (effector.parent_group.empty() || is_group(effector.parent_group)) &&
        unknown_.check(document_, node, "link", effector.parent_link, links_)) {
      semantics_.end_effectors.push_back(effector);
    }
  }

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

  // Reports joints without a motor, such as casters, which MoveIt does not plan for.
  void note_passive_joints() {
    std::vector<std::string> passive;
    for (const pugi::xml_node& node : top_.children("passive_joint")) {
      const auto joint = std::ranges::find(
          robot_.joints, std::string(node.attribute("name").value()), &Joint::name);
      if (joint != robot_.joints.end() && joint->type != JointType::kFixed && !joint->mimic) {
        passive.push_back(joint->name);
      }
    }
    if (!passive.empty()) {
      semantics_.warnings.push_back(
          fmt::format("passive joints of the SRDF move like other joints: {}; leave them out by "
                      "the scene's group",
                      fmt::join(passive, ", ")));
    }
  }

  // Allows all collisions of a link but those in `enable_collisions`, as of MoveIt's coarse shapes.
  void allow_all_of(const pugi::xml_node& node) {
    const std::string link = document_.need(node, "link");
    const bool is_known = unknown_.check(document_, node, "link", link, links_);
    for (const std::string& other : links_) {
      if (is_known && other != link) {
        semantics_.allowed.allow(link, other, AllowedReason::kUser);
      }
    }
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
  const RobotDescription& robot_;
  std::vector<std::string> links_;
  std::vector<std::string> joints_;
  UnknownNames unknown_;
  Semantics semantics_;
};

// Handway's element `<coupling joint="J" offset="0"><follows joint="K"
// multiplier="1"/>…</coupling>`.
void couple_joints(const XmlDocument& document, RobotDescription& robot) {
  const auto number = [&](const pugi::xml_node& node, const char* attribute, double usual) {
    const std::string text = node.attribute(attribute).value();
    const std::optional<double> value = text.empty() ? usual : parse_number(text);
    if (!value) {
      throw InputError({document.where(node), std::string("coupling, attribute ") + attribute,
                        "\"" + text + "\"", "a finite number", ""});
    }
    return *value;
  };
  for (const pugi::xml_node& node : document.root("robot").children("coupling")) {
    JointCoupling coupling{document.need(node, "joint"), {}, number(node, "offset", 0.0)};
    for (const pugi::xml_node& term : node.children("follows")) {
      coupling.terms.emplace_back(document.need(term, "joint"), number(term, "multiplier", 1.0));
    }
    couple_joint(robot, coupling, document.where(node), "coupling of " + coupling.joint);
  }
}

}  // namespace

void read_srdf(const std::filesystem::path& file, RobotDescription& robot) {
  const XmlDocument document(file, kWhat);
  add_virtual_joints(document, robot);
  Semantics srdf = SrdfReader(document, robot).read();
  if (const std::string name = document.root("robot").attribute("name").value();
      name != robot.name) {
    srdf.warnings.push_back(file.string() + " is written for a robot called \"" + name + "\"");
  }
  robot.groups = std::move(srdf.groups);
  robot.end_effectors = std::move(srdf.end_effectors);
  robot.postures = std::move(srdf.postures);
  robot.allowed_collisions = std::move(srdf.allowed);
  std::ranges::move(srdf.warnings, std::back_inserter(robot.warnings));
  couple_joints(document, robot);
}

std::vector<std::string> srdf_group_names(const std::filesystem::path& file) {
  const XmlDocument document(file, kWhat);
  std::vector<std::string> names;
  for (const pugi::xml_node& group : document.root("robot").children("group")) {
    names.emplace_back(group.attribute("name").value());
  }
  return names;
}

}  // namespace handway::geometric
