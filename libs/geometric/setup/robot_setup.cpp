#include "handway/geometric/setup/robot_setup.h"

#include <string>
#include <vector>

namespace handway::geometric {

GroupProposal decided_groups(const RobotModel& model, WristOwner wrist) {
  GroupProposal groups = propose_groups(model);
  if (wrist != WristOwner::kUndecided) {
    std::vector<std::string>& owner = wrist == WristOwner::kArm ? groups.arm : groups.hand;
    owner.insert(owner.begin(), groups.wrist.begin(), groups.wrist.end());
    groups.wrist.clear();
    groups.questions.clear();
  }
  return groups;
}

RobotDescription with_setup(const RobotModel& model, const SelfCollisionSamples& sampled,
                            const GroupProposal& groups, const SetupDecisions& decisions) {
  RobotDescription robot = model.description();
  const AllowedCollisions before = robot.allowed_collisions;
  robot.allowed_collisions = allowed_collisions(model, sampled);
  for (const auto& [pair, reason] : before.entries()) {
    if (reason == AllowedReason::kUser) {
      robot.allowed_collisions.allow(pair.first, pair.second, reason);
    }
  }
  for (const auto& [pair, may_touch] : decisions.may_touch) {
    if (may_touch) {
      robot.allowed_collisions.allow(pair.first, pair.second, AllowedReason::kUser);
    } else {
      robot.allowed_collisions.forbid(pair.first, pair.second);
    }
  }
  if (decisions.wrist != WristOwner::kUndecided) {
    std::erase_if(robot.groups, [](const JointGroup& group) {
      return group.name == "arm" || group.name == "hand";
    });
  }
  add_groups(groups, robot);
  return robot;
}

}  // namespace handway::geometric
