#include "handway/planning/core/observer.h"
#include "handway/planning/planners/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::unique_ptr<Planner> planner_as_shipped() { return PlannerRegistry().create("pmd-prm"); }

std::unique_ptr<Planner> planner_as_printed() {
  std::unique_ptr<Planner> planner = planner_as_shipped();
  planner->set_parameter("preset", "print");
  return planner;
}

std::string value_of(Planner& planner, const std::string& key) {
  return to_text(find_parameter(planner.parameters(), key));
}

// The upper arm is held between two pins of the robot's own base, 20 µm away on either side: hardly
// a sample of the arm is free. Only the hand has to move.
PlanningProblem held_between_pins() {
  constexpr double kAngle = -1.0;
  constexpr double kAside = 0.02 + 0.005 + 20e-6;
  const Eigen::AngleAxisd turn(kAngle, Eigen::Vector3d::UnitZ());
  geometric::RobotDescription robot = test::planar_hand_arm();
  for (const double side : {-kAside, kAside}) {
    const geometric::Pose X_LG(turn * Eigen::Translation3d(0.2, side, 0.0));
    robot.links.front().collision.push_back({geometric::Box{{0.01, 0.01, 0.1}}, X_LG, {}});
  }
  robot.allowed_collisions = {};
  robot.allowed_collisions.allow("upper", "lower", geometric::AllowedReason::kAdjacent);
  for (const auto& [a, b] : {std::pair("lower", "palm"),
                             {"palm", "thumb"},
                             {"palm", "left"},
                             {"palm", "right"},
                             {"left", "left_tip"},
                             {"right", "right_tip"}}) {
    robot.allowed_collisions.allow(a, b, geometric::AllowedReason::kAdjacent);
  }
  return test::planar_problem(test::scene_of(robot), test::planar_configuration(kAngle, 0.0, 0.3),
                              test::planar_configuration(kAngle, 0.0, -0.3));
}

TEST(PmdPrm, NamesWhatDepartsFromThePrint) {
  std::vector<std::string> keys;
  for (const geometric::Parameter& parameter : departures(planner_as_shipped()->parameters())) {
    keys.push_back(parameter.key);
  }
  EXPECT_THAT(keys, ElementsAre("rho_max", "fill_gaps", "n_checked", "smoothing"));
  EXPECT_THAT(departures(planner_as_printed()->parameters()), IsEmpty());
}

TEST(PmdPrm, PresetsGiveValuesToWhatIsNotSetInAnyOrder) {
  const auto planner = planner_as_shipped();
  planner->set_parameter("rho_max", "0.03");
  planner->set_parameter("preset", "authors");
  planner->set_parameter("goal_samples", "3");
  EXPECT_EQ(value_of(*planner, "rho_max"), "0.03");
  EXPECT_EQ(value_of(*planner, "goal_samples"), "3");
  EXPECT_EQ(value_of(*planner, "growth"), "linear");
  EXPECT_EQ(value_of(*planner, "corridor"), "cartesian");
  EXPECT_EQ(value_of(*planner, "neighbour_distance"), "4");
}

TEST(PmdPrm, ReturnsToItsDefaultsWithThePresetThatShips) {
  const auto full = PlannerRegistry().create("full-prm");
  full->set_parameter("preset", "authors");
  full->set_parameter("preset", "print");
  EXPECT_THAT(departures(full->parameters()), IsEmpty());
  full->set_parameter("preset", "shipped");
  const auto fresh = PlannerRegistry().create("full-prm");
  for (const geometric::Parameter& parameter : fresh->parameters()) {
    EXPECT_EQ(value_of(*full, parameter.key), to_text(parameter)) << parameter.key;
  }
}

TEST(PmdPrm, SamplesAroundTheGoalBeforeTheFirstPass) {
  const auto planner = planner_as_shipped();
  planner->set_parameter("goal_samples", "10");
  planner->set_parameter("max_samples", "100");
  const PlanResult result = planner->plan(test::walled_in_problem(), {});
  EXPECT_EQ(result.status, PlanStatus::kSamplesSpent);
  EXPECT_GE(result.statistics.edges, 10U);  // all ten nodes are near the goal and joined to it
  EXPECT_EQ(result.statistics.nodes_per_pmds.front(), 10U);
}

TEST(PmdPrm, ConnectsFartherNodesWithALargerNeighbourDistance) {
  const auto edges = [](const char* distance) {
    const auto planner = planner_as_shipped();
    planner->set_parameter("neighbour_distance", distance);
    planner->set_parameter("max_samples", "300");
    return planner->plan(test::walled_in_problem(), {}).statistics.edges;
  };
  EXPECT_LT(edges("0.01"), edges("1"));
}

TEST(PmdPrm, GrowsTheCorridorWithoutLimitAsPrinted) {
  const auto printed = planner_as_printed();
  printed->set_parameter("rho_a", "0.02");
  printed->set_parameter("max_samples", "20000");
  EXPECT_GT(printed->plan(test::walled_in_problem(), {}).statistics.final_rho_a, 1.0);
  const auto shipped = planner_as_shipped();
  shipped->set_parameter("rho_a", "0.02");
  shipped->set_parameter("max_samples", "20000");
  EXPECT_DOUBLE_EQ(shipped->plan(test::walled_in_problem(), {}).statistics.final_rho_a, 0.05);
}

TEST(PmdPrm, GrowsTheCorridorByEqualStepsAsTheAuthorsProgram) {
  const auto linear = planner_as_printed();
  linear->set_parameter("growth", "linear");
  linear->set_parameter("max_samples", "20000");
  const PlanStatistics statistics = linear->plan(test::walled_in_problem(), {}).statistics;
  EXPECT_GT(statistics.passes, 2U);
  EXPECT_DOUBLE_EQ(statistics.final_rho_a, static_cast<double>(statistics.passes) * 0.001);
  EXPECT_THAT(departures(linear->parameters()),
              ElementsAre(testing::Field(&geometric::Parameter::key, "growth")));
}

/// Records the places of nodes, edges and search ranges, and stops after three samples.
class RangeRecorder final : public Observer {
 public:
  void on_node(const NodeEvent& node) override { places.push_back(node.step); }
  void on_edge(int from, int to) override { edges.emplace_back(from, to); }
  void on_search_range(double d_ini, double d_goal) override {
    ranges.emplace_back(d_ini, d_goal);
    if (places.size() == 5) {
      stop.request_stop();
    }
  }

  std::vector<double> places;  ///< By node; start and goal are the first.
  std::vector<std::pair<int, int>> edges;
  std::vector<std::pair<double, double>> ranges;  ///< After each hypercube.
  std::stop_source stop;
};

// The print's own example (Fig. 13): of three samples, at 0, 1 and 0.5, the first and the last are
// in the component of the start, the second in that of the goal. Then 0.5 to 1 is left.
TEST(PmdPrm, NarrowsTheSearchRangeAsInTheExampleOfFig13) {
  bool seen = false;
  for (std::uint64_t seed = 1; seed <= 40 && !seen; ++seed) {
    RangeRecorder recorder;
    static_cast<void>(planner_as_printed()->plan(test::walled_in_problem(), {.seed = seed},
                                                 recorder.stop.get_token(), &recorder));
    const std::vector<std::pair<int, int>> by_start{{0, 2}, {1, 3}, {0, 4}};
    const std::vector<std::pair<int, int>> by_first_sample{{0, 2}, {1, 3}, {2, 4}};
    seen = recorder.places == std::vector{0.0, 1.0, 0.0, 1.0, 0.5} &&
           (recorder.edges == by_start || recorder.edges == by_first_sample);
    if (seen) {
      EXPECT_THAT(recorder.ranges,
                  ElementsAre(std::pair(0.0, 1.0), std::pair(0.0, 1.0), std::pair(0.5, 1.0)));
    }
  }
  EXPECT_TRUE(seen);
}

TEST(PmdPrm, ChecksNAtTheEndOfEachPassAsPrinted) {
  const auto printed = planner_as_printed();
  printed->set_parameter("max_samples", "100");
  const PlanResult result = printed->plan(test::walled_in_problem(), {});
  EXPECT_EQ(result.status, PlanStatus::kSamplesSpent);
  EXPECT_EQ(result.statistics.passes, 1U);
  EXPECT_GT(result.statistics.samples, 100U);
  const auto shipped = planner_as_shipped();
  shipped->set_parameter("max_samples", "100");
  EXPECT_EQ(shipped->plan(test::walled_in_problem(), {}).statistics.samples, 100U);
}

TEST(PmdPrm, StallsWithoutAnyLimitWhereThereIsNothingToSample) {
  const auto shipped = planner_as_shipped();
  const auto printed = planner_as_printed();
  for (Planner* planner : {shipped.get(), printed.get()}) {
    planner->set_parameter("arm_trials", "1");
    planner->set_parameter("n_a", "2");
    const PlanResult result = planner->plan(held_between_pins(), {});
    EXPECT_EQ(result.status, PlanStatus::kStalled);
    EXPECT_THAT(result.reason, HasSubstr("stalled after"));
    EXPECT_TRUE(result.path.empty());
  }
}

}  // namespace
}  // namespace handway::planning
