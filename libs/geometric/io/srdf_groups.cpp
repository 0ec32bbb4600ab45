#include "io/srdf_groups.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/nearest_name.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace handway::geometric {
namespace {

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

  // An empty node if there is none of that name.
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

  // What `attribute` names, if the robot has it.
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

}  // namespace

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

std::vector<JointGroup> srdf_groups(const XmlDocument& document, const RobotDescription& robot,
                                    UnknownNames& unknown) {
  return GroupReader(document, robot, unknown).read();
}

}  // namespace handway::geometric
