#include "handway/planning/paths/path_optimizer.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::planning {
namespace {

constexpr double kCheckResolution = 1e-3;  // m

/// A post that blocks the flat arm, with fingers that spread together in the subspace; start and
/// goal are outside of it.
PlanningProblem problem_outside_of_subspace() {
  PlanningProblem problem = test::post_problem();
  sampling::PmdBasis basis = test::planar_hand_basis();
  basis.directions.resize(1);
  problem.basis = std::make_shared<const sampling::PmdBasis>(std::move(basis));
  for (Configuration* end : {&problem.start, &problem.goal}) {
    (*end)(problem.joints.hand) = Eigen::Vector3d(0.0, 0.6, 0.1);
  }
  return problem;
}

std::unique_ptr<Planner> auto_planner() { return PlannerRegistry().create("auto"); }

class Optimizer : public testing::Test {
 protected:
  static ObjectiveWeights human_like() { return {.human_likeness = 10.0}; }

  Path found() {
    const auto planner = PlannerRegistry().create("rrt-connect");
    planner->set_parameter("smoothing_checks", "0");
    return planner->plan(problem_, {}).path;
  }
  Path optimized(const Path& path, const ObjectiveWeights& weights, std::uint64_t checks,
                 std::uint64_t seed = 3) {
    PlanningContext context(problem_, request_, {}, observer_);
    PathOptimizer optimizer(context, weights, path, seed);
    optimizer.advance(checks);
    return optimizer.path();
  }
  double cost(const Path& path, const ObjectiveWeights& weights) {
    return Objective(problem_, weights).cost(path);
  }

  PlanningProblem problem_ = problem_outside_of_subspace();
  PlanRequest request_;
  Observer observer_;
};

TEST_F(Optimizer, LowersTheCostOfEachObjectiveAndKeepsPathsFree) {
  const Path path = found();
  ASSERT_FALSE(path.empty());
  for (const ObjectiveWeights& weights :
       {ObjectiveWeights{}, human_like(), ObjectiveWeights{.clearance = 4.0},
        ObjectiveWeights{.length = 0.01, .duration = 1.0}}) {
    const Path better = optimized(path, weights, 5000);
    EXPECT_LT(cost(better, weights), cost(path, weights));
    EXPECT_EQ(better.waypoints.front(), problem_.start);
    EXPECT_EQ(better.waypoints.back(), problem_.goal);
    const PathCheckResult check = check_path(problem_, better, kCheckResolution);
    EXPECT_TRUE(check.valid()) << (check.faults.empty() ? "" : check.faults.front());
  }
}

TEST_F(Optimizer, PrunesPathsOfManyWaypointsFirst) {
  const Path path = found();
  Path trembling;  // to and fro between the waypoints
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    for (const double share : {0.0, 0.3, 0.1, 0.4, 0.2, 0.6, 0.5, 0.8, 0.7}) {
      trembling.waypoints.push_back(path.waypoints[i] +
                                    share * (path.waypoints[i + 1] - path.waypoints[i]));
    }
  }
  trembling.waypoints.push_back(path.waypoints.back());
  ASSERT_GT(trembling.waypoints.size(), 30U);
  EXPECT_LE(optimized(trembling, {}, 200).waypoints.size(), path.waypoints.size());
}

TEST_F(Optimizer, LeadsTheHandIntoTheSubspace) {
  const Path path = found();
  const PathQuality human = path_quality(problem_, optimized(path, human_like(), 5000));
  const PathQuality shortest = path_quality(problem_, optimized(path, {}, 5000));
  EXPECT_LT(human.human_likeness->mean, 0.7 * shortest.human_likeness->mean);
  EXPECT_LT(human.human_likeness->mean, 1.3 * human.human_likeness->forced);
}

TEST_F(Optimizer, KnowsHowMuchOfTheHandsDistanceIsTheEndsFault) {
  const Path path = found();
  PlanningContext context(problem_, request_, {}, observer_);
  const PathOptimizer optimizer(context, human_like(), path, 3);
  const PathQuality quality = path_quality(problem_, path);
  EXPECT_NEAR(optimizer.avoidable_distance(),
              quality.human_likeness->mean - quality.human_likeness->forced, 1e-3);
  EXPECT_EQ(PathOptimizer(context, {}, path, 3).avoidable_distance(), 0.0);
}

TEST_F(Optimizer, KeepsAwayFromObstaclesIfThatIsWhatCounts) {
  const Path path = found();
  const PathQuality safest = path_quality(problem_, optimized(path, {.clearance = 4.0}, 20000));
  const PathQuality shortest = path_quality(problem_, optimized(path, {}, 20000));
  EXPECT_GT(safest.mean_clearance, shortest.mean_clearance);
}

TEST_F(Optimizer, SpendsAboutWhatItMay) {
  constexpr std::uint64_t kOvershoot = 60;  // samples of a posture beside one that collides
  const Path path = found();
  for (const std::uint64_t checks : {0, 10, 100, 1000}) {
    PlanningContext context(problem_, request_, {}, observer_);
    PathOptimizer optimizer(context, human_like(), path, 3);
    optimizer.advance(checks);
    EXPECT_LE(context.statistics().checks(), checks + kOvershoot);
    EXPECT_LE(optimizer.cost(), cost(path, human_like()) + 1e-12);
    if (checks == 0) {
      EXPECT_EQ(optimizer.path().waypoints, path.waypoints);
    }
  }
}

TEST_F(Optimizer, GivesTheSamePathForTheSameSeed) {
  const Path path = found();
  EXPECT_EQ(optimized(path, human_like(), 2000).waypoints,
            optimized(path, human_like(), 2000).waypoints);
}

TEST_F(Optimizer, GoesOnWithPathsThatAreALongWayRound) {
  struct Smoothed {
    double length;
    std::uint64_t checks;
  };
  const auto smoothed = [&](const Path& path, int most_rounds) {
    constexpr int kChecks = 40;
    PlanningContext context(problem_, request_, {}, observer_);
    PlanResult result;
    smooth_result(context, {static_cast<int>(ObjectivePreset::kShortest), {}}, kChecks, path,
                  result, most_rounds);
    return Smoothed{cost(result.path, {}), context.statistics().checks()};
  };
  const Path past_a_post = found();
  Path to_and_fro = past_a_post;
  for (int i = 0; i < 2; ++i) {
    std::vector<Configuration> back = past_a_post.waypoints;
    if (i == 0) {
      std::ranges::reverse(back);
    }
    to_and_fro.waypoints.insert(to_and_fro.waypoints.end(), back.begin() + 1, back.end());
  }
  const Smoothed once = smoothed(to_and_fro, 1);
  const Smoothed often = smoothed(to_and_fro, 6);
  EXPECT_GT(often.checks, once.checks);
  EXPECT_LT(often.length, 0.9 * once.length);
}

TEST_F(Optimizer, Converges) {
  PlanningContext context(problem_, request_, {}, observer_);
  PathOptimizer optimizer(context, human_like(), found(), 3);
  optimizer.advance(1'000'000);
  EXPECT_TRUE(optimizer.converged());
  EXPECT_LT(context.statistics().checks(), 500'000U);
}

TEST_F(Optimizer, RepeatsWhatItDidInSomeTimeByTheNumberOfChecks) {
  const auto planner = auto_planner();
  PlanRequest request;
  request.optimize_s = 0.05;
  const PlanResult timed = planner->plan(problem_, request);
  ASSERT_TRUE(timed.solved());
  ASSERT_GT(timed.optimize_checks, 0U);
  const auto again = auto_planner();
  again->set_parameter("optimize_checks", std::to_string(timed.optimize_checks));
  const PlanResult counted = again->plan(problem_, {});
  EXPECT_EQ(counted.path.waypoints, timed.path.waypoints);
  EXPECT_EQ(counted.optimize_checks, timed.optimize_checks);
}

TEST_F(Optimizer, GoesOnLaterAsIfItHadNotPaused) {
  constexpr int kNeverConverges = 1'000'000;
  PlanningContext context(problem_, request_, {}, observer_);
  PathOptimizer at_once(context, human_like(), found(), 3, kNeverConverges);
  const auto rounds = [](std::uint64_t checks) {
    return [checks](std::uint64_t done) { return done < checks; };
  };
  EXPECT_EQ(at_once.advance_in_rounds(rounds(4000)), 4000U);
  PlanningContext other(problem_, request_, {}, observer_);
  PathOptimizer with_pause(other, human_like(), found(), 3, kNeverConverges);
  EXPECT_EQ(with_pause.advance_in_rounds(rounds(1000)), 1000U);
  EXPECT_EQ(with_pause.advance_in_rounds(rounds(3000)), 3000U);
  EXPECT_EQ(with_pause.path().waypoints, at_once.path().waypoints);
}

TEST(AutoPlannerTest, MovesTheHandInTheSubspaceOfAnyBasis) {
  const PlanningProblem problem = problem_outside_of_subspace();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanRequest request;
    request.seed = seed;
    const PlanResult human = auto_planner()->plan(problem, request);
    const auto shortest = auto_planner();
    shortest->set_parameter("objective", "shortest");
    const PlanResult direct = shortest->plan(problem, request);
    ASSERT_TRUE(human.solved() && direct.solved()) << seed;
    const PathQuality quality = path_quality(problem, human.path);
    EXPECT_LT(quality.human_likeness->mean, path_quality(problem, direct.path).human_likeness->mean)
        << seed;
    EXPECT_TRUE(check_path(problem, human.path, kCheckResolution).valid()) << seed;
  }
}

TEST(AutoPlannerTest, PlansOverAllJointsWithoutABasisAndSaysSo) {
  PlanningProblem problem = test::post_problem();
  problem.basis = nullptr;
  const PlanResult result = auto_planner()->plan(problem, {});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_NE(result.reason.find("the scene has no hand basis"), std::string::npos) << result.reason;
  EXPECT_TRUE(check_path(problem, result.path, kCheckResolution).valid());
}

TEST(AutoPlannerTest, FindsTheSameForAnyNumberOfThreads) {
  const PlanningProblem problem = problem_outside_of_subspace();
  PlanRequest two;
  two.threads = 2;
  EXPECT_EQ(auto_planner()->plan(problem, two).path.waypoints,
            auto_planner()->plan(problem, {}).path.waypoints);
}

TEST(SearchReachOfPlanners, IsKnownWhereNoPathIsFound) {
  for (const char* name : {"pmd-rrt-connect", "rrt-connect"}) {
    const auto planner = PlannerRegistry().create(name);
    planner->set_parameter("max_samples", "300");
    const PlanResult result = planner->plan(test::walled_in_problem(), {});
    ASSERT_FALSE(result.solved());
    ASSERT_TRUE(result.reach);
    EXPECT_GT(result.reach->start_nodes, 1U);
    EXPECT_GE(result.reach->goal_nodes, 1U);
    EXPECT_LE(result.reach->start_nodes + result.reach->goal_nodes, result.reach->nodes);
    EXPECT_GE(result.reach->from_start, 0.0);
    EXPECT_LE(result.reach->from_goal, 1.0);
    const auto progress = [](const Configuration& q) {
      const PlanningProblem problem = test::walled_in_problem();
      const Eigen::VectorXd start = geometric::normalised(problem.model(), problem.start);
      const Eigen::VectorXd motion = geometric::normalised(problem.model(), problem.goal) - start;
      return std::clamp(
          (geometric::normalised(problem.model(), q) - start).dot(motion) / motion.squaredNorm(),
          0.0, 1.0);
    };
    EXPECT_NEAR(progress(result.reach->farthest_from_start), result.reach->from_start, 1e-12);
    EXPECT_NEAR(progress(result.reach->farthest_from_goal), result.reach->from_goal, 1e-12);
  }
}

}  // namespace
}  // namespace handway::planning
