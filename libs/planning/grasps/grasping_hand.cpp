#include "grasps/grasping_hand.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/edits/scene_edits.h"

#include <algorithm>
#include <string>
#include <vector>

namespace handway::planning {

using geometric::HandStructure;
using geometric::Pose;

const geometric::SceneObject& graspable_object(const PlanningProblem& problem,
                                               std::string_view name) {
  const std::string file = problem.scene->file.string();
  const geometric::SceneObject& object = need_object(*problem.scene, name);
  if (object.attachment) {
    throw geometric::InputError({file, "object", std::string(name), "an object that stands still",
                                 "Choose another one to grasp"});
  }
  if (geometric::tessellate(object.shape)->empty()) {
    throw geometric::InputError(
        {file, "object " + std::string(name), "no triangles", "an object with a surface", ""});
  }
  if (const std::vector<CarriedObject> carried = carried_objects(*problem.scene);
      problem.joints.hand.empty() && !carried.empty()) {
    throw geometric::InputError({file, "object", std::string(name),
                                 "a hand that is free: it carries " + carried.front().name,
                                 "Detach what it carries first"});
  }
  if (problem.joints.hand.empty()) {
    throw geometric::InputError({file, "robot " + problem.scene->robots.front().name,
                                 "no joints of a hand", "a robot with a hand",
                                 "Mount a hand, or name its group \"hand\" in the SRDF"});
  }
  return object;
}

PlanningProblem with_nearest_hand(const PlanningProblem& problem,
                                  const geometric::SceneObject& object) {
  PlanningProblem of_one = problem;
  if (problem.scene->group.empty() && !problem.basis) {  // a goal is no choice of a hand
    of_one.joints = geometric::JointSelection::of_groups(problem.model());
  }
  std::vector<geometric::Limb> found = limbs(problem.model(), of_one.joints);
  std::erase_if(found, [](const geometric::Limb& limb) { return limb.hand.empty(); });
  if (found.size() < 2) {
    return problem;
  }
  const geometric::RobotInstance& robot = problem.scene->robots.front();
  std::vector<Pose> X_BL(static_cast<std::size_t>(problem.model().link_count()));
  problem.model().forward_kinematics(problem.start, X_BL);
  const auto distance = [&](const geometric::Limb& limb) {
    const int palm = HandStructure::of(problem.model(), limb.arm, limb.hand).palm;
    const Pose X_WP = robot.X_WB * X_BL[static_cast<std::size_t>(palm)];
    return (X_WP.translation() - object.X_PO.translation()).norm();
  };
  const auto nearest = std::ranges::min_element(found, {}, distance);
  for (auto other = found.begin(); other != found.end(); ++other) {
    if (other != nearest) {
      std::erase_if(of_one.joints.arm,
                    [&](int v) { return std::ranges::count(other->arm, v) > 0; });
      std::erase_if(of_one.joints.hand,
                    [&](int v) { return std::ranges::count(other->hand, v) > 0; });
    }
  }
  of_one.hand = HandStructure::of(problem.model(), of_one.joints.arm, of_one.joints.hand);
  if (problem.basis && of_one.joints.hand.size() < problem.joints.hand.size()) {
    of_one.basis = nullptr;  // its directions are of both
  }
  return of_one;
}

}  // namespace handway::planning
