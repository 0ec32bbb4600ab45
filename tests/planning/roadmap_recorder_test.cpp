#include "handway/planning/roadmap/roadmap_recorder.h"

#include "handway/planning/planners/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <algorithm>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

NodeEvent node(int id, const Configuration& q, int search = 0) {
  return {.id = id, .q = q, .pmd_count = id % 3, .rho_a = 0.1, .search = search};
}

TEST(RoadmapRecorder, KeepsNodesAndEdges) {
  const Configuration a = Eigen::Vector2d(0.0, 1.0);
  const Configuration b = Eigen::Vector2d(2.0, 3.0);
  RoadmapRecorder recorder(10);
  recorder.on_node(node(4, a));
  recorder.on_node(node(8, b));
  recorder.on_edge(8, 4);
  recorder.on_search_range(0.25, 0.5);
  const RecordedRoadmap& roadmap = recorder.roadmap();
  ASSERT_THAT(roadmap.nodes, SizeIs(2));
  EXPECT_EQ(roadmap.nodes[0].q, a);
  EXPECT_EQ(roadmap.nodes[1].q, b);
  EXPECT_EQ(roadmap.nodes[0].pmd_count, 1);
  EXPECT_EQ(roadmap.nodes[1].rho_a, 0.1);
  EXPECT_THAT(roadmap.edges, ElementsAre(Pair(1, 0))) << "by index, not by number";
  EXPECT_THAT(roadmap.search_range, Pair(0.25, 0.5));
  EXPECT_EQ(roadmap.left_out, 0U);
}

TEST(RoadmapRecorder, CountsWhatItDoesNotKeep) {
  const Configuration q = Eigen::Vector2d::Zero();
  RoadmapRecorder recorder(2);
  for (int id = 0; id < 5; ++id) {
    recorder.on_node(node(id, q));
  }
  recorder.on_edge(0, 1);
  recorder.on_edge(1, 2);
  EXPECT_THAT(recorder.roadmap().nodes, SizeIs(2));
  EXPECT_EQ(recorder.roadmap().left_out, 3U);
  EXPECT_THAT(recorder.roadmap().edges, ElementsAre(Pair(0, 1))) << "no edge to a node left out";
}

TEST(RoadmapRecorder, TellsTheWinnersRoadmapFromTheOthers) {
  const Configuration q = Eigen::Vector2d::Zero();
  RoadmapRecorder recorder(10);
  recorder.on_node(node(0, q, 0));
  recorder.on_node(node(1, q, 1));
  recorder.on_node(node(3, q, 1));
  recorder.on_node(node(2, q, 0));
  recorder.on_edge(0, 2);
  recorder.on_edge(1, 3);
  EXPECT_THAT(recorder.roadmap().of_winner().nodes, SizeIs(4)) << "nobody has won";
  recorder.on_winner(1);
  const RecordedRoadmap winner = recorder.roadmap().of_winner();
  EXPECT_THAT(winner.nodes, SizeIs(2));
  EXPECT_THAT(winner.edges, ElementsAre(Pair(0, 1)));
}

// Every search of a portfolio begins with start and goal; the path has to be the winner's.
TEST(RoadmapRecorder, HasTheWholeRoadmapOfARace) {
  const PlanningProblem problem = test::post_problem();
  RoadmapRecorder recorder(100000);
  const PlanResult result = PlannerRegistry().create("auto")->plan(problem, {}, {}, &recorder);
  ASSERT_TRUE(result.solved()) << result.reason;
  ASSERT_TRUE(recorder.roadmap().winner);
  EXPECT_EQ(recorder.roadmap().nodes.size(), result.statistics.nodes);
  const RecordedRoadmap winner = recorder.roadmap().of_winner();
  const auto count = [&](const Configuration& q) {
    return std::ranges::count_if(winner.nodes, [&](const auto& node) { return node.q == q; });
  };
  EXPECT_EQ(count(problem.start), 1);
  EXPECT_EQ(count(problem.goal), 1);
  EXPECT_THAT(winner.edges, testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace handway::planning
