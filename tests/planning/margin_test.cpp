/// Paths that keep a margin from obstacles, measured by FCL on the meshes.
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/known_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace handway::planning {
namespace {

constexpr double kMargin = 0.01;  // m
constexpr double kLookSpacing = 0.02;

PlanResult planned_with_margin(const PlanningProblem& problem, double margin) {
  PlanRequest request;
  request.margin = margin;
  request.time_limit_s = 60.0;
  return PlannerRegistry().create("auto")->plan(problem, request);
}

class Margin : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static PlanningProblem problem() {
    const std::vector<test::KnownProblem> known = test::known_problems();
    const auto found = std::ranges::find(known, GetParam(), &test::KnownProblem::name);
    const SceneState scene = test::load(*found);
    return make_problem(scene.scene, scene.basis);
  }
};

std::vector<Configuration> along(const Path& path) {
  std::vector<Configuration> configurations;
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    const Configuration motion = path.waypoints[i + 1] - path.waypoints[i];
    const int parts = 1 + static_cast<int>(motion.cwiseAbs().maxCoeff() / kLookSpacing);
    for (int k = 0; k < parts; ++k) {
      configurations.emplace_back(path.waypoints[i] + static_cast<double>(k) / parts * motion);
    }
  }
  return configurations;
}

TEST_P(Margin, IsKeptByAllPairsThatAreNotNamed) {
  const PlanningProblem asked = problem();
  const PlanResult result = planned_with_margin(asked, kMargin);
  ASSERT_TRUE(result.solved()) << result.reason;
  std::set<std::pair<std::string, std::string>> named;
  for (const OutOfMargin& near : result.out_of_margin) {
    named.emplace(near.pair.a, near.pair.b);
    EXPECT_LT(near.pair.distance, kMargin + 2e-4);
  }
  const geometric::CollisionWorld& world = asked.checker->world();
  geometric::FclChecker reference(asked.checker->shared_world());
  double least = 2.0 * kMargin;
  for (const Configuration& q : along(result.path)) {
    reference.place(q);
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      const geometric::NamedPair bodies = named_pair(world, pair, 0.0);
      const bool moves = asked.motion->bound(pair, Eigen::VectorXd::Ones(q.size())) > 0.0;
      if (moves && !world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]) &&
          !named.contains({bodies.a, bodies.b})) {
        least = std::min(least, reference.pair_distance(pair, 2.0 * kMargin));
      }
    }
  }
  EXPECT_GE(least, kMargin - 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Margin, testing::Values("can_in_box", "can_on_table", "t_shape"),
                         [](const auto& scene) { return scene.param; });

TEST(MarginOfARequest, IsNeverNegative) {
  const SceneState scene = test::load(test::known_problems().front());
  const PlanningProblem problem = make_problem(scene.scene, scene.basis);
  EXPECT_THROW(static_cast<void>(planned_with_margin(problem, -1.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(planned_with_margin(problem, std::nan(""))),
               std::invalid_argument);
}

TEST(MarginOfARequest, OfNothingNamesNothing) {
  const SceneState scene = test::load(test::known_problems().front());
  const PlanResult result = planned_with_margin(make_problem(scene.scene, scene.basis), 0.0);
  EXPECT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(result.out_of_margin, testing::IsEmpty());
}

}  // namespace
}  // namespace handway::planning
