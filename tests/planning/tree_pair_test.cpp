#include "planners/tree_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using testing::ElementsAre;

// The nodes are on a line: start 0 at x = 0, goal 1 at x = 10.
class ATreePair : public testing::Test {
 protected:
  static Eigen::VectorXd at(double x) { return Eigen::VectorXd::Constant(1, x); }
  int add(double x, int parent) { return trees_.add(at(x), at(x), parent, false); }

  TreePair trees_{at(0), at(0), at(10), at(10)};
};

TEST_F(ATreePair, FindsTheNearestNodeOfEitherTree) {
  const int two = add(2, 0);
  const int eight = add(8, 1);
  EXPECT_EQ(trees_.nearest(0, at(7)), two);
  EXPECT_EQ(trees_.nearest(1, at(1)), eight);
  EXPECT_EQ(trees_.nearest(0, at(-1)), 0);
}

TEST_F(ATreePair, KeepsItsNodesWhileItGrows) {
  int last = 0;
  for (int i = 1; i <= 500; ++i) {
    last = add(0.01 * i, last);
  }
  EXPECT_EQ(trees_.size(), 502);
  EXPECT_DOUBLE_EQ(trees_.coordinates(2)[0], 0.01);
  EXPECT_EQ(trees_.nearest(0, at(2.503)), 251);
}

TEST_F(ATreePair, ListsTheNodesOfEitherTree) {
  const int two = add(2, 0);
  const int four = add(4, two);
  const int eight = add(8, 1);
  EXPECT_THAT(trees_.nodes(0), ElementsAre(0, two, four));
  EXPECT_THAT(trees_.nodes(1), ElementsAre(1, eight));
  EXPECT_EQ(trees_.parent(four), two);
  EXPECT_EQ(trees_.parent(1), 1) << "a root";
  trees_.cut(trees_.connection(four, eight), 1, true);  // between 2 and 4
  EXPECT_THAT(trees_.nodes(0), ElementsAre(0, two));
  EXPECT_THAT(trees_.nodes(1), ElementsAre(1, four, eight));
}

TEST_F(ATreePair, LeadsFromStartToGoalOverTheBridge) {
  const int two = add(2, 0);
  const int four = add(4, two);
  const int eight = add(8, 1);
  const TreePair::Connection connection = trees_.connection(four, eight);
  EXPECT_THAT(connection.nodes, ElementsAre(0, two, four, eight, 1));
  EXPECT_EQ(connection.bridge, 2U);
  EXPECT_THAT(connection.certain, ElementsAre(false, false, false, false));
}

TEST_F(ATreePair, RemembersWhatIsCertain) {
  const int two = add(2, 0);
  const int four = add(4, two);
  const int eight = add(8, 1);
  TreePair::Connection connection = trees_.connection(four, eight);
  trees_.confirm(connection, 0);
  trees_.confirm(connection, connection.bridge);
  trees_.confirm(connection, 3);
  EXPECT_THAT(trees_.connection(four, eight).certain, ElementsAre(true, false, false, true));
}

TEST_F(ATreePair, HandsACutBranchToTheOtherTree) {
  const int two = add(2, 0);
  const int four = add(4, two);
  const int twig = add(4.5, four);
  const int eight = add(8, 1);
  const TreePair::Connection connection = trees_.connection(four, eight);
  trees_.cut(connection, 1, true);  // between 2 and 4
  EXPECT_EQ(trees_.tree_of(two), 0);
  EXPECT_EQ(trees_.tree_of(four), 1);
  EXPECT_EQ(trees_.tree_of(twig), 1);
  const TreePair::Connection other = trees_.connection(two, twig);
  EXPECT_THAT(other.nodes, ElementsAre(0, two, twig, four, eight, 1));
  EXPECT_THAT(other.certain, ElementsAre(false, false, false, true, false))
      << "the bridge of before is known to be free";
}

TEST_F(ATreePair, HandsACutBranchOfTheGoalToTheStart) {
  const int two = add(2, 0);
  const int eight = add(8, 1);
  const int six = add(6, eight);
  trees_.cut(trees_.connection(two, six), 3, false);  // between 8 and the goal
  EXPECT_EQ(trees_.tree_of(eight), 0);
  EXPECT_EQ(trees_.tree_of(six), 0);
  EXPECT_THAT(trees_.connection(eight, 1).nodes, ElementsAre(0, two, six, eight, 1));
}

TEST_F(ATreePair, LosesNothingWhenTheBridgeIsNotFree) {
  const int two = add(2, 0);
  const int eight = add(8, 1);
  const TreePair::Connection connection = trees_.connection(two, eight);
  trees_.cut(connection, connection.bridge, false);
  EXPECT_EQ(trees_.tree_of(two), 0);
  EXPECT_EQ(trees_.tree_of(eight), 1);
}

}  // namespace
}  // namespace handway::planning
