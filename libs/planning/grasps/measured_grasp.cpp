#include "grasps/measured_grasp.h"

#include "grasps/finger_closing.h"
#include "grasps/grasp_measurement.h"
#include "grasps/hand_closing.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/queries/palm_ik.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace handway::planning {
namespace {

// The scene with all of its joints: that of a stage names those of the arm alone.
PlanningProblem problem_of_hand(const SceneState& state, const std::stop_token& stop) {
  geometric::Scene scene = *state.scene;
  scene.group.clear();
  return make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), state.basis,
                      {stop}, GoalNeed::kOptional);
}

}  // namespace

Pregrasp measured_grasp(const SceneState& state, const std::string& name, const Configuration& q,
                        const std::stop_token& stop) {
  const PlanningProblem problem = problem_of_hand(state, stop);
  if (problem.joints.hand.empty()) {
    throw geometric::InputError(
        {source_of(*state.scene), "robot", "no joints of a hand", "a robot with a hand", ""});
  }
  const geometric::SceneObject& object = *geometric::find_object(*problem.scene, name);
  const auto checker = problem.checker->clone();
  const PalmIk ik(problem.scene->robots.front().model, problem.hand.palm, problem.joints.arm);
  const HandClosing hand(problem);
  const std::vector<int> with_object = checker->world().pairs_with(name);
  FingerClosing closing(problem, hand, *checker, with_object, {});
  const PregraspOptions options;
  GraspMeasurement measurement({problem, ik, hand, *checker, closing}, object, with_object, options,
                               stop);
  Pregrasp grasp{q};
  measurement.measure_held(grasp, q, geometric::bounding_box(*geometric::tessellate(object.shape)));
  if (touching_fingers(grasp) < 2) {
    throw geometric::InputError({source_of(*state.scene), "object " + name,
                                 fmt::format("{} fingers that touch it", touching_fingers(grasp)),
                                 "two or more at the beginning of the path",
                                 "Close the hand around it first"});
  }
  return grasp;
}

}  // namespace handway::planning
