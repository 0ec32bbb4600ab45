/// Goals as grasps have them, a few hundredths of a millimetre from contact, are reached or refused
/// at once.
#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/nearest_free.h"
#include "handway/sampling/sequences/random_stream.h"
#include "handway_test/known_problems.h"
#include "handway_test/scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

namespace handway::planning {
namespace {

using geometric::metres;

PlanningProblem can_on_table() {
  for (const test::KnownProblem& known : test::known_problems()) {
    if (known.name == "can_on_table") {
      const SceneState scene = test::load(known);
      return make_problem(scene.scene, scene.basis);
    }
  }
  throw std::runtime_error("no scene can_on_table");
}

TEST(ExpansiveTrees, SolveEveryKnownProblem) {
  constexpr std::uint64_t kChecks = 60'000;  // trees that draw targets take 100,000 on one of them
  for (const test::KnownProblem& known : test::known_problems()) {
    SCOPED_TRACE(known.name);
    const SceneState scene = test::load(known);
    const PlanningProblem problem = make_problem(scene.scene, scene.basis);
    for (const std::string corridor : {"joint", "cartesian"}) {
      const auto planner = PlannerRegistry().create("pmd-rrt-connect");
      for (const auto& [key, value] :
           {std::pair("expansions", std::string("1")), std::pair("range", std::string("0.1")),
            std::pair("corridor", corridor)}) {
        planner->set_parameter(key, value);
      }
      const PlanResult result = planner->plan(problem, {});
      ASSERT_TRUE(result.solved()) << result.reason;
      EXPECT_LT(result.statistics.checks(), kChecks);
      EXPECT_TRUE(check_path(problem, result.path, metres(1.0)).valid());
    }
  }
}

double clearance(const PlanningProblem& problem, const Configuration& q) {
  return geometric::find_clearance(*problem.checker->clone(), q, metres(1.0)).distance;
}

/// Random postures around the scene's goal, with a given clearance.
class NearGoals {
 public:
  NearGoals(const PlanningProblem& problem, std::uint64_t seed)
      : problem_(problem), checker_(problem.checker->clone()), random_(seed) {}

  /// Clear of everything by `least` to `most`, m.
  Configuration next(double least, double most) {
    while (true) {
      Configuration free = problem_.goal;
      Configuration colliding = drawn();
      if (!checker_->first_collision(colliding)) {
        continue;
      }
      for (int i = 0; i < 60; ++i) {
        const Configuration middle = 0.5 * (free + colliding);
        const double there = geometric::find_clearance(*checker_, middle, metres(1.0)).distance;
        if (there >= least && there <= most) {
          return middle;
        }
        (there < least ? colliding : free) = middle;
      }
    }
  }

  double uniform(double lower, double upper) { return lower + random_.uniform() * (upper - lower); }

 private:
  Configuration drawn() {
    const geometric::RobotModel& model = problem_.model();
    Configuration q = problem_.goal;
    for (int v = 0; v < q.size(); ++v) {
      q[v] += 0.1 * (random_.uniform() - 0.5) * (model.upper()[v] - model.lower()[v]);
    }
    return q.cwiseMax(model.lower()).cwiseMin(model.upper());
  }

  const PlanningProblem& problem_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  sampling::RandomStream random_;
};

PlanResult planned(const PlanningProblem& problem, std::uint64_t seed) {
  PlanRequest request;
  request.seed = seed;
  request.time_limit_s = 60.0;
  return PlannerRegistry().create("auto")->plan(problem, request);
}

TEST(NearContact, GoalsAreReachedOrRefusedAtOnce) {
  PlanningProblem problem = can_on_table();
  NearGoals goals(problem, 7);
  const int count = test::scaled(20);
  int solved = 0;
  for (int i = 0; i < count; ++i) {
    const double wanted = metres(0.005 * std::pow(10.0, goals.uniform(0.0, 1.0)));
    problem.goal = goals.next(0.9 * wanted, wanted);
    const double at_goal = clearance(problem, problem.goal);
    const PlanResult result = planned(problem, static_cast<std::uint64_t>(i));
    if (!result.solved()) {
      EXPECT_EQ(result.status, PlanStatus::kGoalInvalid) << result.reason;
      EXPECT_LT(result.time_s, 1.0);
      continue;
    }
    ++solved;
    EXPECT_TRUE(check_path(problem, result.path, 1e-3).valid());
    EXPECT_NEAR(result.certificate.resolution_at_goal, 0.5 * at_goal, 1e-9);
    EXPECT_EQ(result.certificate.resolution_at_start, result.certificate.resolution);
    EXPECT_GT(result.certificate.min_clearance, 0.0);
    EXPECT_LE(result.certificate.min_clearance, at_goal + 1e-9);
  }
  std::cout << solved << " of " << count << " goals reached\n";
  EXPECT_GE(solved, 0.9 * count);
}

TEST(NearContact, GoalsWithinTwoMicrometresAreRefusedWithThePair) {
  PlanningProblem problem = can_on_table();
  NearGoals goals(problem, 8);
  problem.goal = goals.next(1e-8, 1.9e-6);
  const PlanResult result = planned(problem, 1);
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason,
              testing::AllOf(testing::HasSubstr("too close"), testing::HasSubstr(" with "),
                             testing::HasSubstr("0.002 mm")));
  const NearestFree nearest = find_nearest_free(problem, problem.goal);
  ASSERT_TRUE(nearest.q);
  EXPECT_GE(clearance(problem, *nearest.q), 2e-6);
  problem.goal = *nearest.q;
  EXPECT_TRUE(planned(problem, 1).solved());
}

}  // namespace
}  // namespace handway::planning
