/// Contract of every planner, built in or from a plugin, whatever its method.
#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/input_errors.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kPi = std::numbers::pi;
constexpr Eigen::Index kShoulder = 0;

std::string word_of(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

const PlannerRegistry& registry() {
  static const PluginManager kExtensions = [] {
    PluginManager plugins;
    plugins.load_plugins(HANDWAY_PLUGINS);
    return plugins;
  }();
  return kExtensions.planners();
}

std::unique_ptr<Planner> planner_with(const std::string& name, const std::string& samples) {
  std::unique_ptr<Planner> planner = registry().create(name);
  planner->set_parameter("max_samples", samples);
  return planner;
}

/// Records its notifications.
class Recorder : public Observer {
 public:
  void on_node(const NodeEvent& node) override {
    EXPECT_TRUE(nodes.emplace(node.id, node.q).second) << "node " << node.id << " told twice";
    steps.emplace(node.id, node.step);
  }
  void on_edge(int from, int to) override {
    EXPECT_TRUE(nodes.contains(from) && nodes.contains(to)) << from << " to " << to;
    edges.emplace_back(from, to);
  }
  void on_search_range(double d_ini, double d_goal) override {
    EXPECT_LE(0.0, d_ini);
    EXPECT_LE(d_ini, d_goal);
    EXPECT_LE(d_goal, 1.0);
  }
  void on_progress(double fraction, std::string_view activity) override {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(activity.empty());
  }

  std::map<int, Configuration> nodes;
  std::map<int, double> steps;
  std::vector<std::pair<int, int>> edges;
};

struct Problem {
  const char* name;
  PlanningProblem (*make)();
};

class SolvableProblem : public testing::TestWithParam<std::tuple<std::string, Problem>> {
 protected:
  PlanResult plan(const PlanRequest& request, Observer* observer = nullptr) const {
    return planner_with(std::get<0>(GetParam()), "20000")->plan(problem_, request, {}, observer);
  }

  PlanningProblem problem_ = std::get<1>(GetParam()).make();
};

TEST_P(SolvableProblem, IsSolvedWithAPathThatHolds) {
  const PlanResult result = plan({});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(result.reason, Not(IsEmpty()));
  ASSERT_GE(result.path.waypoints.size(), 2U);
  EXPECT_EQ(result.path.waypoints.front(), problem_.start) << "to the bit";
  EXPECT_EQ(result.path.waypoints.back(), problem_.goal) << "to the bit";
  const PathCheckResult check = check_path(problem_, result.path, 0.001);
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_GT(check.configurations, 100U);
  EXPECT_GT(result.certificate.min_clearance, 0.0);
  EXPECT_LE(result.certificate.min_clearance, check.min_clearance + 1e-9);
  EXPECT_EQ(result.certificate.resolution, PlanRequest{}.resolution);
  EXPECT_GT(result.certificate.checks, 0U);
}

TEST_P(SolvableProblem, CountsWhatItDid) {
  const PlanResult result = plan({});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_GE(result.statistics.nodes, 2U) << "start and goal included";
  EXPECT_GE(result.statistics.edges, 1U);
  EXPECT_GE(result.statistics.edges_tested, result.statistics.edges);
  EXPECT_TRUE(result.statistics.samples > 0 || result.statistics.nodes == 2);
  EXPECT_GT(result.statistics.node_checks, 0U);
  EXPECT_GT(result.statistics.edge_checks, 0U);
  EXPECT_GE(result.time_s, 0.0);
  EXPECT_GE(result.smoothing_s, 0.0);
}

TEST_P(SolvableProblem, IsSolvedAlikeOnEveryRunAndForAnyThreads) {
  PlanRequest request;
  request.seed = 7;
  const PlanResult first = plan(request);
  ASSERT_TRUE(first.solved()) << first.reason;
  const bool parallel = planner_with(std::get<0>(GetParam()), "1")->capabilities().uses_threads;
  for (const int threads : parallel ? std::vector{1, 2, 4} : std::vector{2}) {
    request.threads = threads;
    const PlanResult again = plan(request);
    EXPECT_EQ(again.path.waypoints, first.path.waypoints) << threads << " threads";
    EXPECT_EQ(again.statistics.samples, first.statistics.samples);
    EXPECT_EQ(again.statistics.nodes, first.statistics.nodes);
    EXPECT_EQ(again.statistics.edges, first.statistics.edges);
    EXPECT_EQ(again.statistics.node_checks, first.statistics.node_checks);
    EXPECT_EQ(again.statistics.edges_tested, first.statistics.edges_tested);
    EXPECT_EQ(again.statistics.rejections, first.statistics.rejections) << threads << " threads";
    EXPECT_EQ(again.certificate.min_clearance, first.certificate.min_clearance);
  }
}

TEST_P(SolvableProblem, IsSolvedForOtherSeeds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanRequest request;
    request.seed = seed;
    const PlanResult result = plan(request);
    ASSERT_TRUE(result.solved()) << seed << ": " << result.reason;
    EXPECT_THAT(check_path(problem_, result.path, 0.002).faults, IsEmpty()) << seed;
  }
}

TEST_P(SolvableProblem, IsToldToAnObserver) {
  Recorder recorder;
  const PlanResult result = plan({}, &recorder);
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_EQ(recorder.nodes.size(), result.statistics.nodes);
  EXPECT_EQ(recorder.edges.size(), result.statistics.edges);
  const auto told = [&](const Configuration& q) {
    return std::ranges::any_of(recorder.nodes, [&](const auto& node) { return node.second == q; });
  };
  EXPECT_TRUE(told(problem_.start) && told(problem_.goal));
  const PlanResult unwatched = plan({});
  EXPECT_EQ(unwatched.path.waypoints, result.path.waypoints) << "watching changes nothing";
}

TEST_P(SolvableProblem, IsSolvedBackwardsToo) {
  std::swap(problem_.start, problem_.goal);
  const PlanResult result = plan({});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(check_path(problem_, result.path, 0.001).faults, IsEmpty());
}

// In this problem only the hand moves: the arm's corridor is a point.
PlanningProblem hand_only_problem() {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(0.1, 0.2, 0.0, 0.1, 0.0);
  problem.goal = test::planar_configuration(0.1, 0.2, 0.5, 0.9, 1.0);
  return problem;
}

// The planners of planner_ompl differ by a line of a table: two of each space pass all tests here,
// and each of them most of these in its own tests.
std::vector<std::string> names() {
  const std::set<std::string> kept = {"ompl-prm", "ompl-rrt-connect", "ompl-pmd-est",
                                      "ompl-pmd-rrt-star"};
  std::vector<std::string> names = registry().names();
  std::erase_if(names, [&](const std::string& name) {
    return name.starts_with("ompl-") && !kept.contains(name);
  });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Planners, SolvableProblem,
                         testing::Combine(testing::ValuesIn(names()),
                                          testing::Values(Problem{"Open", test::open_problem},
                                                          Problem{"Post", test::post_problem},
                                                          Problem{"HandOnly", hand_only_problem})),
                         [](const auto& test) {
                           return word_of(std::get<0>(test.param)) + "_" +
                                  std::get<1>(test.param).name;
                         });

class EveryPlanner : public testing::TestWithParam<std::string> {};

TEST_P(EveryPlanner, GivesUpInWordsWhereThereIsNoPath) {
  const PlanningProblem problem = test::walled_in_problem();
  const PlanResult result = planner_with(GetParam(), "200")->plan(problem, {});
  EXPECT_EQ(result.status, PlanStatus::kSamplesSpent);
  EXPECT_FALSE(result.solved());
  EXPECT_TRUE(result.path.empty()) << "an approximate path is no path";
  EXPECT_THAT(result.reason, HasSubstr("samples"));
  EXPECT_GE(result.statistics.samples, 200U);
  EXPECT_LE(result.statistics.samples, 210U);
}

// The reported place is that of a hypercube around the segment, or of the node itself.
TEST_P(EveryPlanner, TellsWhereOnTheArmsMotionItsNodesAre) {
  const PlanningProblem problem = test::walled_in_problem();
  Recorder recorder;
  static_cast<void>(planner_with(GetParam(), "300")->plan(problem, {}, {}, &recorder));
  const bool draws_hypercubes = GetParam() == "pmd-prm" || GetParam() == "full-prm";
  const double tolerance = draws_hypercubes ? 0.2 : 1e-12;
  bool between = false;
  for (const auto& [id, q] : recorder.nodes) {
    const double step = recorder.steps.at(id);
    EXPECT_NEAR(step, arm_progress(problem, q), tolerance) << id;
    between = between || (step > 0.1 && step < 0.9);
  }
  EXPECT_TRUE(between) << "nodes at the ends alone";
}

TEST_P(EveryPlanner, StopsAtTheTimeLimit) {
  const PlanningProblem problem = test::walled_in_problem();
  PlanRequest request;
  request.time_limit_s = 0.2;
  const auto begin = std::chrono::steady_clock::now();
  const PlanResult result = planner_with(GetParam(), "100000000")->plan(problem, request);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(result.status, PlanStatus::kTimeLimit);
  EXPECT_THAT(result.reason, HasSubstr("0.2 s"));
  EXPECT_TRUE(result.path.empty());
  EXPECT_GE(took.count(), 0.2);
  EXPECT_LT(took.count(), 2.0);
}

TEST_P(EveryPlanner, StopsWhenAsked) {
  const PlanningProblem problem = test::walled_in_problem();
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  const std::jthread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  const PlanResult result =
      planner_with(GetParam(), "100000000")->plan(problem, {}, stop.get_token());
  const std::chrono::duration<double> late = std::chrono::steady_clock::now() - asked;
  EXPECT_EQ(result.status, PlanStatus::kCancelled);
  EXPECT_THAT(result.reason, HasSubstr("ancelled"));
  EXPECT_LT(late.count(), 1.0) << "100 ms, and something for a busy machine";
}

TEST_P(EveryPlanner, SolvesNothingOnceStopped) {
  std::stop_source stop;
  stop.request_stop();
  const PlanResult result =
      planner_with(GetParam(), "1000")->plan(test::open_problem(), {}, stop.get_token());
  EXPECT_EQ(result.status, PlanStatus::kCancelled);
}

TEST_P(EveryPlanner, RefusesInvalidEnds) {
  PlanningProblem problem = test::post_problem();
  const auto planner = planner_with(GetParam(), "1000");
  problem.start = test::planar_configuration(-0.066, 0);  // a finger in the post
  EXPECT_EQ(planner->plan(problem, {}).status, PlanStatus::kStartInvalid);
  std::swap(problem.start, problem.goal);
  EXPECT_EQ(planner->plan(problem, {}).status, PlanStatus::kGoalInvalid);
}

TEST_P(EveryPlanner, StaysWhereItIs) {
  PlanningProblem problem = test::post_problem();
  problem.goal = problem.start;
  const PlanResult result = planner_with(GetParam(), "2000")->plan(problem, {});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_EQ(result.path.waypoints.front(), problem.start);
  EXPECT_EQ(result.path.waypoints.back(), problem.goal);
}

TEST_P(EveryPlanner, CanBeUsedAgain) {
  const auto planner = planner_with(GetParam(), "100000");
  const PlanningProblem open = test::open_problem();
  const PlanResult first = planner->plan(open, {});
  static_cast<void>(planner->plan(test::post_problem(), {}));
  EXPECT_EQ(planner->plan(open, {}).path.waypoints, first.path.waypoints);
}

TEST_P(EveryPlanner, SaysWhatItNeeds) {
  const auto planner = planner_with(GetParam(), "100000");
  EXPECT_TRUE(planner->capabilities().deterministic);
  PlanningProblem problem = test::open_problem();
  problem.basis = nullptr;
  if (planner->capabilities().needs_basis) {
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(planner->plan(problem, {})); }),
                HasSubstr("hand_basis"));
  } else {
    EXPECT_TRUE(planner->plan(problem, {}).solved());
  }
}

TEST_P(EveryPlanner, TakesTheShorterArcOfAContinuousJoint) {
  const PlanningProblem problem = test::endless_problem(2.6, -2.6);
  const auto planner = planner_with(GetParam(), "20000");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanRequest request;
    request.seed = seed;
    const PlanResult result = planner->plan(problem, request);
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_EQ(result.path.waypoints.front(), problem.start) << "to the bit";
    EXPECT_NEAR(result.path.waypoints.back()[kShoulder], 2 * kPi - 2.6, 1e-12) << "unwrapped";
    EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty());
    double turned = 0.0;
    for (std::size_t w = 0; w + 1 < result.path.waypoints.size(); ++w) {
      turned +=
          std::abs(result.path.waypoints[w + 1][kShoulder] - result.path.waypoints[w][kShoulder]);
    }
    EXPECT_LT(turned, 2.5) << "seed " << seed << ": 1.1 rad would do, 5.2 the other way";
  }
}

// A joint that was turned several times by earlier paths is planned from its present value.
TEST_P(EveryPlanner, StartsAContinuousJointFromAnyTurn) {
  const PlanningProblem problem = test::endless_problem(20.0, 20.5 - 6 * kPi);
  const PlanResult result = planner_with(GetParam(), "20000")->plan(problem, {});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_EQ(result.path.waypoints.front()[kShoulder], 20.0);
  EXPECT_NEAR(result.path.waypoints.back()[kShoulder], 20.5, 1e-12);
  EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty());
}

// Planners with a corridor look around the straight motion alone.
TEST_P(EveryPlanner, TurnsAContinuousJointTheOtherWayWhereTheShorterArcIsBlocked) {
  if (GetParam().find("pmd-") != std::string::npos || GetParam() == "full-prm") {
    GTEST_SKIP() << "looks around the straight motion alone";
  }
  const PlanningProblem problem = test::endless_problem_with_wall();
  ASSERT_NEAR(problem.goal[kShoulder], 2 * kPi - 2.7, 1e-12);
  const auto planner = planner_with(GetParam(), "20000");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanRequest request;
    request.seed = seed;
    const PlanResult result = planner->plan(problem, request);
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_NEAR(result.path.waypoints.back()[kShoulder], -2.7, 1e-12) << "the other way round";
    EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlanner, testing::ValuesIn(names()),
                         [](const auto& test) { return word_of(test.param); });

}  // namespace
}  // namespace handway::planning
