#include "roadmap/lazy_roadmap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

int add(LazyRoadmap& roadmap, double x, double y) {
  const Eigen::Vector2d p(x, y);
  return roadmap.add_node(p, p);
}

// Nodes 0 to 3: start, goal, one a little off the straight line, one far off.
LazyRoadmap two_ways_round() {
  LazyRoadmap roadmap(5);
  add(roadmap, 0, 0);
  add(roadmap, 2, 0);
  add(roadmap, 1, 0.5);
  add(roadmap, 1, -2);
  return roadmap;
}

TEST(LazyRoadmap, TakesEveryEdgeAsFreeAtFirst) {
  const LazyRoadmap roadmap = two_ways_round();
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 1));
  EXPECT_FALSE(roadmap.is_certain(0, 1));
  EXPECT_DOUBLE_EQ(roadmap.distance(0, 1), 2.0);
}

TEST(LazyRoadmap, GoesTheNextShortestWayWhenAnEdgeIsGone) {
  LazyRoadmap roadmap = two_ways_round();
  roadmap.remove_edge(0, 1);
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 2, 1));
  roadmap.remove_edge(2, 1);
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 3, 1));
}

TEST(LazyRoadmap, SaysWhenNoWayIsLeft) {
  LazyRoadmap roadmap = two_ways_round();
  for (const int node : {0, 2, 3}) {
    roadmap.remove_edge(node, 1);
  }
  EXPECT_THAT(roadmap.shortest_path(0, 1), IsEmpty());
}

TEST(LazyRoadmap, FindsAWayAgainOverANewNode) {
  LazyRoadmap roadmap = two_ways_round();
  for (const int node : {0, 2, 3}) {
    roadmap.remove_edge(node, 1);
  }
  const int added = add(roadmap, 1.5, 1.0);
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, added, 1));
}

TEST(LazyRoadmap, JoinsANodeToItsNearestOnly) {
  LazyRoadmap roadmap(1);
  for (const double x : {0.0, 1.0, 2.0, 3.0}) {
    add(roadmap, x, 0.0);
  }
  EXPECT_EQ(roadmap.node_count(), 4);
  EXPECT_THAT(roadmap.shortest_path(0, 3), ElementsAre(0, 1, 2, 3));
}

TEST(LazyRoadmap, RemembersWhatIsCertainBothWays) {
  LazyRoadmap roadmap = two_ways_round();
  roadmap.confirm_edge(0, 2);
  EXPECT_TRUE(roadmap.is_certain(2, 0));
  EXPECT_FALSE(roadmap.is_certain(1, 2));
}

}  // namespace
}  // namespace handway::planning
