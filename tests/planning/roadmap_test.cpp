#include "roadmap/roadmap.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Reference =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_weight_t, double>>;

struct RandomGraph {
  RandomGraph(std::mt19937& random, int nodes, int edges);

  Roadmap<> roadmap;
  Reference reference;
};

RandomGraph::RandomGraph(std::mt19937& random, int nodes, int edges)
    : reference(static_cast<std::size_t>(nodes)) {
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  std::uniform_int_distribution<int> node(0, nodes - 1);
  for (int i = 0; i < nodes; ++i) {
    const Eigen::Vector3d p(coordinate(random), coordinate(random), coordinate(random));
    roadmap.add_node(p, p);
  }
  for (int i = 0; i < edges; ++i) {
    const int a = node(random);
    const int b = node(random);
    if (a != b) {
      roadmap.edge(a, b);
      boost::add_edge(static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                      roadmap.distance(a, b), reference);
    }
  }
}

double length(const Roadmap<>& roadmap, const std::vector<int>& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    sum += roadmap.distance(path[i], path[i + 1]);
  }
  return sum;
}

TEST(Roadmap, FindsPathsAsShortAsDijkstra) {
  std::mt19937 random(3);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int nodes = 5 + trial;
    const RandomGraph graph(random, nodes, 2 * nodes);
    std::vector<double> lengths(static_cast<std::size_t>(nodes));
    boost::dijkstra_shortest_paths(graph.reference, 0, boost::distance_map(lengths.data()));
    for (int to = 1; to < nodes; ++to) {
      const std::vector<int> path = graph.roadmap.shortest_path(0, to);
      const double expected = lengths[static_cast<std::size_t>(to)];
      if (expected == std::numeric_limits<double>::max()) {
        EXPECT_THAT(path, IsEmpty());
        continue;
      }
      ++found;
      ASSERT_FALSE(path.empty());
      EXPECT_EQ(path.front(), 0);
      EXPECT_EQ(path.back(), to);
      EXPECT_NEAR(length(graph.roadmap, path), expected, 1e-12);
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        EXPECT_TRUE(boost::edge(static_cast<std::size_t>(path[i]),
                                static_cast<std::size_t>(path[i + 1]), graph.reference)
                        .second);
      }
    }
  }
  EXPECT_GT(found, 500);
}

TEST(Roadmap, KnowsItsComponents) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const int nodes = 30;
    const RandomGraph graph(random, nodes, 20);
    std::vector<int> component(static_cast<std::size_t>(nodes));
    boost::connected_components(graph.reference, component.data());
    for (int a = 0; a < nodes; ++a) {
      for (int b = 0; b < nodes; ++b) {
        EXPECT_EQ(graph.roadmap.same_component(a, b),
                  component[static_cast<std::size_t>(a)] == component[static_cast<std::size_t>(b)]);
      }
    }
  }
}

struct OnALine : Roadmap<> {
  OnALine(std::initializer_list<double> positions) {
    for (const double x : positions) {
      const Eigen::VectorXd p = Eigen::VectorXd::Constant(1, x);
      add_node(p, p);
    }
  }
};

TEST(Roadmap, ListsTheNearestFirst) {
  const OnALine roadmap{0.0, 0.5, 0.1, 0.9, 0.2};
  EXPECT_THAT(roadmap.nearest(0, 3, 10.0), ElementsAre(2, 4, 1));
  EXPECT_THAT(roadmap.nearest(0, 10, 10.0), ElementsAre(2, 4, 1, 3));
  EXPECT_THAT(roadmap.nearest(0, 10, 0.2), ElementsAre(2, 4)) << "the threshold counts as near";
  EXPECT_THAT(roadmap.nearest(3, 10, 0.1), IsEmpty());
}

TEST(Roadmap, CountsNodesAndEdges) {
  OnALine roadmap{0.0, 0.25, 1.0};
  EXPECT_EQ(roadmap.node_count(), 3);
  EXPECT_EQ(roadmap.edge_count(), 0);
  roadmap.edge(0, 1);
  EXPECT_EQ(roadmap.edge_count(), 1);
  EXPECT_EQ(roadmap.distance(0, 1), 0.25);
  EXPECT_EQ(roadmap.configuration(2)[0], 1.0);
  EXPECT_TRUE(roadmap.same_component(1, 0));
  EXPECT_FALSE(roadmap.same_component(0, 2));
}

TEST(Roadmap, GoesFromANodeToItself) {
  EXPECT_THAT(OnALine({0.0, 1.0}).shortest_path(1, 1), ElementsAre(1));
}

TEST(Roadmap, GoesTheNextShortestWayWhenAnEdgeIsGone) {
  Roadmap<> roadmap;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 0),
                                   Eigen::Vector2d(1, 0.5), Eigen::Vector2d(1, -2)}) {
    const int added = roadmap.add_node(p, p);
    for (int other = 0; other < added; ++other) {
      roadmap.edge(added, other);
    }
  }
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 1));
  roadmap.remove_edge(0, 1);
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 2, 1));
  roadmap.remove_edge(2, 1);
  EXPECT_THAT(roadmap.shortest_path(0, 1), ElementsAre(0, 3, 1));
  roadmap.remove_edge(3, 1);
  EXPECT_THAT(roadmap.shortest_path(0, 1), IsEmpty());
}

}  // namespace
}  // namespace handway::planning
