#include "handway/geometric/robot/composed_robot.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/group_proposal.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

namespace handway::geometric {
namespace {

/// Names of one kind of thing in all parts: shared names get their part's name.
class PartNames {
 public:
  template <typename ItemsOf>
  PartNames(const std::vector<RobotPart>& parts, const ItemsOf& items_of) : first_(&parts.front()) {
    std::set<std::string> seen;
    for (const RobotPart& part : parts) {
      std::set<std::string> own;
      for (const auto& item : items_of(part.model->description())) {
        own.insert(item.name);
      }
      for (const std::string& name : own) {
        if (!seen.insert(name).second) {
          shared_.insert(name);
        }
      }
    }
  }

  [[nodiscard]] std::string in(const RobotPart& part, const std::string& name) const {
    return &part == first_ || !shared_.contains(name) ? name : part.name + '/' + name;
  }

  template <typename Items>
  [[nodiscard]] std::map<std::string, std::string> all_in(const RobotPart& part,
                                                          const Items& items) const {
    std::map<std::string, std::string> names;
    for (const auto& item : items) {
      names[item.name] = in(part, item.name);
    }
    return names;
  }

 private:
  const RobotPart* first_;
  std::set<std::string> shared_;
};

const RobotDescription& own(const RobotPart& part) { return part.model->description(); }

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  std::ranges::copy_if(more, std::back_inserter(names), [&](const std::string& name) {
    return std::ranges::count(names, name) == 0;
  });
}

std::vector<std::string> moving_joints(const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) {
    if (joint.type != JointType::kFixed) {
      names.push_back(joint.name);
    }
  }
  return names;
}

const JointGroup* find_group(const RobotDescription& robot, const std::string& name) {
  const auto group = std::ranges::find(robot.groups, name, &JointGroup::name);
  return group == robot.groups.end() ? nullptr : &*group;
}

/// The joints of a part that are of the arm and of the hand, by the part's own names.
struct ArmAndHand {
  std::vector<std::string> arm;
  std::vector<std::string> hand;
  std::vector<GroupQuestion> questions;
};

ArmAndHand arm_and_hand(const RobotPart& part) {
  const JointGroup* arm = find_group(own(part), "arm");
  const JointGroup* hand = find_group(own(part), "hand");
  if (!arm && !hand) {
    GroupProposal proposal = propose_groups(*part.model);
    return {proposal.arm, proposal.hand_with_wrist(), proposal.questions};
  }
  ArmAndHand found{arm ? arm->joints : moving_joints(own(part)),
                   hand ? hand->joints : std::vector<std::string>(),
                   {}};
  std::erase_if(found.arm,
                [&](const auto& joint) { return std::ranges::count(found.hand, joint) > 0; });
  return found;
}

class Composer {
 public:
  explicit Composer(std::vector<RobotPart>& parts)
      : parts_(parts),
        groups_(parts, [](const auto& robot) { return robot.groups; }),
        end_effectors_(parts, [](const auto& robot) { return robot.end_effectors; }),
        postures_(parts, [](const auto& robot) { return robot.postures; }) {
    const PartNames links(parts, [](const auto& robot) { return robot.links; });
    const PartNames joints(parts, [](const auto& robot) { return robot.joints; });
    for (RobotPart& part : parts) {
      part.links = links.all_in(part, own(part).links);
      part.joints = joints.all_in(part, own(part).joints);
    }
  }

  [[nodiscard]] RobotDescription compose() {
    whole_.file = own(parts_.front()).file;
    whole_.virtual_joints = own(parts_.front()).virtual_joints;
    for (const RobotPart& part : parts_) {
      whole_.name += (whole_.name.empty() ? "" : "_") + part.model->name();
      add_tree(part);
      add_groups(part);
      add_postures(part);
      for (const auto& [pair, reason] : own(part).allowed_collisions.entries()) {
        whole_.allowed_collisions.allow(part.links.at(pair.first), part.links.at(pair.second),
                                        reason);
      }
    }
    add_arm_and_hand();
    std::ranges::for_each(parts_, [&](const RobotPart& part) { add_part_group(part); });
    std::ranges::for_each(parts_, [&](const RobotPart& part) { add_end_effectors(part); });
    return std::move(whole_);
  }

 private:
  [[nodiscard]] static std::vector<std::string> renamed(const RobotPart& part,
                                                        const std::vector<std::string>& joints) {
    std::vector<std::string> names;
    std::ranges::transform(joints, std::back_inserter(names),
                           [&](const std::string& joint) { return part.joints.at(joint); });
    return names;
  }

  [[nodiscard]] std::string group_name(const RobotPart& part, const std::string& name) const {
    return name == "arm" || name == "hand" ? name : groups_.in(part, name);
  }

  [[nodiscard]] std::string carrying_link(const RobotPart& part) const {
    const RobotPart& carrier = parts_[static_cast<std::size_t>(part.carrier)];
    const auto link = carrier.links.find(part.link);
    if (link == carrier.links.end()) {
      throw InputError({"robot " + part.name, "mount.link", "\"" + part.link + "\"",
                        "a link of " + carrier.name, ""});
    }
    return link->second;
  }

  void add_tree(const RobotPart& part) {
    for (Link link : own(part).links) {
      link.name = part.links.at(link.name);
      whole_.links.push_back(std::move(link));
    }
    if (part.carrier >= 0) {
      Joint mount;
      mount.name = part.name + "_mount";
      mount.parent = carrying_link(part);
      mount.child = part.links.at(part.model->link(0).name);
      mount.X_PJ = part.X_LB;
      whole_.joints.push_back(std::move(mount));
    }
    for (Joint joint : own(part).joints) {
      joint.name = part.joints.at(joint.name);
      joint.parent = part.links.at(joint.parent);
      joint.child = part.links.at(joint.child);
      if (joint.mimic) {
        joint.mimic->joint = part.joints.at(joint.mimic->joint);
      }
      whole_.joints.push_back(std::move(joint));
    }
    for (JointCoupling coupling : own(part).couplings) {
      coupling.joint = part.joints.at(coupling.joint);
      for (auto& [joint, multiplier] : coupling.terms) {
        joint = part.joints.at(joint);
      }
      whole_.couplings.push_back(std::move(coupling));
    }
    for (BaseJoint base : own(part).base_joints) {
      const std::string joint = joints_of(base).front();
      base.name = part.joints.at(joint) == joint ? base.name : part.name + '/' + base.name;
      whole_.base_joints.push_back(std::move(base));
    }
  }

  void add_groups(const RobotPart& part) {
    for (const JointGroup& group : own(part).groups) {
      if (group.name != "arm" && group.name != "hand") {
        whole_.groups.push_back({groups_.in(part, group.name), renamed(part, group.joints)});
      }
    }
  }

  void add_postures(const RobotPart& part) {
    for (const NamedPosture& posture : own(part).postures) {
      NamedPosture mine{postures_.in(part, posture.name), group_name(part, posture.group), {}};
      for (const auto& [joint, value] : posture.values) {
        mine.values[part.joints.at(joint)] = value;
      }
      whole_.postures.push_back(std::move(mine));
    }
  }

  void add_arm_and_hand() {
    JointGroup arm{"arm", {}};
    JointGroup hand{"hand", {}};
    for (const RobotPart& part : parts_) {
      const ArmAndHand found = arm_and_hand(part);
      append(arm.joints, renamed(part, found.arm));
      append(hand.joints, renamed(part, found.hand));
      if (!found.hand.empty()) {
        hands_.push_back(&part);
      }
      for (const GroupQuestion& question : found.questions) {
        whole_.warnings.push_back(part.name + ": " + question.open + ". " + question.mend);
      }
    }
    for (JointGroup* group : {&hand, &arm}) {
      if (!group->joints.empty()) {
        whole_.groups.insert(whole_.groups.begin(), std::move(*group));
      }
    }
  }

  void add_part_group(const RobotPart& part) {
    const std::vector<std::string> joints = renamed(part, moving_joints(own(part)));
    if (!joints.empty() && !find_group(whole_, part.name)) {
      whole_.groups.push_back({part.name, joints});
    }
  }

  void add_end_effectors(const RobotPart& part) {
    const std::string arm = find_group(whole_, "arm") && part.carrier >= 0 ? "arm" : "";
    for (const EndEffector& effector : own(part).end_effectors) {
      const bool is_mounted = part.carrier >= 0 && effector.parent_group.empty();
      whole_.end_effectors.push_back(
          {end_effectors_.in(part, effector.name), group_name(part, effector.group),
           is_mounted ? carrying_link(part) : part.links.at(effector.parent_link),
           effector.parent_group.empty() ? arm : group_name(part, effector.parent_group)});
    }
    const bool is_hand = std::ranges::count(hands_, &part) > 0;
    if (is_hand && part.carrier >= 0 && own(part).end_effectors.empty()) {
      whole_.end_effectors.push_back(
          {part.name, hands_.size() == 1 ? "hand" : part.name, carrying_link(part), arm});
    }
  }

  std::vector<RobotPart>& parts_;
  PartNames groups_;
  PartNames end_effectors_;
  PartNames postures_;
  std::vector<const RobotPart*> hands_;
  RobotDescription whole_;
};

}  // namespace

RobotDescription compose_robots(std::vector<RobotPart>& parts) { return Composer(parts).compose(); }

std::optional<int> find_variable_of_part(const RobotModel& model, std::string_view joint) {
  if (const std::optional<int> variable = model.find_variable(joint)) {
    return variable;
  }
  const std::string ending = '/' + std::string(joint);
  std::optional<int> found;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (model.variable(v).name.ends_with(ending)) {
      if (found) {
        return std::nullopt;
      }
      found = v;
    }
  }
  return found;
}

}  // namespace handway::geometric
