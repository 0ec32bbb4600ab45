#include "handway/geometric/robot/hand_alone.h"

#include "handway/geometric/robot/group_proposal.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

std::vector<int> hand_variables(const RobotModel& robot) {
  if (auto hand = robot.find_group("hand"); hand && !hand->empty()) {
    return *std::move(hand);
  }
  std::vector<int> variables;
  for (const std::string& joint : propose_groups(robot).hand_with_wrist()) {
    if (const auto variable = robot.find_variable(joint)) {
      variables.push_back(*variable);
    }
  }
  return variables;
}

/// Parents come before their children, so the later one of two is never above the other.
int common_ancestor(const RobotModel& robot, int a, int b) {
  while (a != b) {
    int& later = a > b ? a : b;
    later = robot.parent(later);
  }
  return a;
}

}  // namespace

std::shared_ptr<const RobotModel> hand_alone(const std::shared_ptr<const RobotModel>& robot) {
  const std::vector<int> hand = hand_variables(*robot);
  if (hand.empty()) {
    return robot;
  }
  int root = robot->parent(robot->variable_link(hand.front()));
  for (const int variable : hand) {
    root = common_ancestor(*robot, root, robot->parent(robot->variable_link(variable)));
  }
  if (root == 0) {
    return robot;
  }
  const RobotDescription& whole = robot->description();
  RobotDescription alone;
  alone.name = whole.name + "_hand";
  alone.file = whole.file;
  std::vector<bool> kept(static_cast<std::size_t>(robot->link_count()), false);
  kept[static_cast<std::size_t>(root)] = true;
  alone.links.push_back(robot->link(root));
  for (int link = root + 1; link < robot->link_count(); ++link) {
    if (kept[static_cast<std::size_t>(robot->parent(link))]) {
      kept[static_cast<std::size_t>(link)] = true;
      alone.links.push_back(robot->link(link));
      alone.joints.push_back(robot->joint(link));
    }
  }
  const auto has_link = [&](const std::string& name) {
    const auto link = robot->find_link(name);
    return link && kept[static_cast<std::size_t>(*link)];
  };
  for (const auto& [pair, reason] : whole.allowed_collisions.entries()) {
    if (has_link(pair.first) && has_link(pair.second)) {
      alone.allowed_collisions.allow(pair.first, pair.second, reason);
    }
  }
  const auto has_joint = [&](const std::string& name) {
    return std::ranges::count(alone.joints, name, &Joint::name) > 0;
  };
  std::ranges::copy_if(whole.couplings, std::back_inserter(alone.couplings),
                       [&](const JointCoupling& coupling) { return has_joint(coupling.joint); });
  return std::make_shared<const RobotModel>(std::move(alone));
}

}  // namespace handway::geometric
