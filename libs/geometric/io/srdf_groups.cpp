#include "io/srdf_groups.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/nearest_name.h"

#include <algorithm>
#include <string_view>

namespace handway::geometric {
namespace {

class GroupReader {
 public:
  GroupReader(const XmlDocument& document, const RobotDescription& robot)
      : document_(document), robot_(robot) {
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
        add(joints, known(part, "joint", document_.need(part, "name"), joint_names_));
      } else if (kind == "link") {
        add_carrier(joints, known(part, "link", document_.need(part, "name"), link_names_));
      } else if (kind == "chain") {
        add_chain(part, joints);
      } else if (kind == "group") {
        add_group(subgroup(part), joints, depth + 1);
      }
    }
  }

  void add_chain(const pugi::xml_node& chain, std::vector<std::string>& joints) {
    const std::string base = known(chain, "link", document_.need(chain, "base_link"), link_names_);
    const std::string tip = known(chain, "link", document_.need(chain, "tip_link"), link_names_);
    std::vector<std::string> upwards;
    for (std::string link = tip; link != base;) {
      const Joint* carrier = carrier_of(link);
      if (!carrier || upwards.size() > robot_.joints.size()) {
        throw InputError({document_.where(chain), "chain", "\"" + base + "\" to \"" + tip + "\"",
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

  [[nodiscard]] const Joint* carrier_of(const std::string& link) const {
    const auto carrier = std::ranges::find(robot_.joints, link, &Joint::child);
    return carrier == robot_.joints.end() ? nullptr : &*carrier;
  }

  [[nodiscard]] pugi::xml_node subgroup(const pugi::xml_node& part) const {
    const std::string name = document_.need(part, "name");
    std::vector<std::string> names;
    for (const pugi::xml_node& group : document_.root("robot").children("group")) {
      if (name == group.attribute("name").value()) {
        return group;
      }
      names.emplace_back(group.attribute("name").value());
    }
    refuse_unknown(document_, part, "group", name, names);
  }

  [[nodiscard]] std::string known(const pugi::xml_node& node, const std::string& kind,
                                  const std::string& name,
                                  const std::vector<std::string>& names) const {
    if (std::ranges::count(names, name) == 0) {
      refuse_unknown(document_, node, kind, name, names);
    }
    return name;
  }

  const XmlDocument& document_;
  const RobotDescription& robot_;
  std::vector<std::string> link_names_;
  std::vector<std::string> joint_names_;
};

}  // namespace

std::vector<JointGroup> srdf_groups(const XmlDocument& document, const RobotDescription& robot) {
  return GroupReader(document, robot).read();
}

void refuse_unknown(const XmlDocument& document, const pugi::xml_node& node,
                    const std::string& kind, const std::string& name,
                    const std::vector<std::string>& known) {
  throw InputError({document.where(node), "<" + std::string(node.name()) + ">",
                    "unknown " + kind + " \"" + name + "\"", "a " + kind + " of the robot",
                    advise_name(name, known)});
}

}  // namespace handway::geometric
