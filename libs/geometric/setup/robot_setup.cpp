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
                            const GroupProposal& groups, WristOwner wrist) {
  RobotDescription robot = model.description();
  const AllowedCollisions before = robot.allowed_collisions;
  robot.allowed_collisions = allowed_collisions(model, sampled);
  for (const auto& [pair, reason] : before.entries()) {
    if (reason == AllowedReason::kUser) {
      robot.allowed_collisions.allow(pair.first, pair.second, reason);
    }
  }
  if (wrist != WristOwner::kUndecided) {
    std::erase_if(robot.groups, [](const JointGroup& group) {
      return group.name == "arm" || group.name == "hand";
    });
  }
  add_groups(groups, robot);
  return robot;
}

}  // namespace handway::geometric
