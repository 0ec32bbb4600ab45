/// Robots whose base moves, among obstacles, by the default planner.
#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace handway::planning {
namespace {

using testing::IsEmpty;

// A problem of the robot in `urdf`, and its scene file's lines after that.
PlanningProblem problem_of(const std::filesystem::path& urdf, const std::string& rest) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "scene.yaml";
  std::ofstream(file) << "handway: 1\nrobots:\n  - model: " << urdf.string() << '\n' << rest;
  return make_problem(std::make_shared<const geometric::Scene>(geometric::read_scene(file)),
                      nullptr);
}

void expect_solved(const PlanningProblem& problem) {
  const PlannerRegistry planners;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PlanRequest request;
    request.seed = seed;
    const PlanResult result = planners.create(planners.names().front())->plan(problem, request);
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty()) << "seed " << seed;
    EXPECT_GT(result.path.waypoints.size(), 2U) << "the straight motion is blocked";
  }
}

TEST(AFreeFlyingHand, FliesAroundAWall) {
  HANDWAY_NEED_REFERENCE(reference);
  expect_solved(problem_of(reference / "robots" / "allegro_hand" / "allegro_hand_right.urdf", R"(
    moving_base: floating
objects:
  - {name: wall, box: {size: [0.02, 0.8, 0.8]}, pose: {xyz: [0, 0, 0]}}
start: {base/trans_x: -0.4, base/yaw: 3}
goal: {base/trans_x: 0.4, base/yaw: -3, base/roll: 1}
)"));
}

TEST(AnArmOnAMobileBase, DrivesAroundAPillar) {
  HANDWAY_NEED_REFERENCE(reference);
  expect_solved(problem_of(reference / "robots" / "iiwa14" / "iiwa14.urdf", R"(
    moving_base: planar
    bounds: {base/x: [-2, 2], base/y: [-1.5, 1.5]}
objects:
  - {name: pillar, cylinder: {radius: 0.3, length: 2}, pose: {xyz: [0, 0, 1]}}
start: {base/x: -1.2, base/theta: 3}
goal: {base/x: 1.2, base/theta: -3}
)"));
}

}  // namespace
}  // namespace handway::planning
