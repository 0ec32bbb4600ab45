#include "motion_check.h"

#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

#include <stop_token>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using State = ompl::base::ScopedState<ompl::base::RealVectorStateSpace>;

/// The stretched hand on one side of a post, that it can't sweep across.
class BesideAPost : public testing::Test {
 protected:
  State state_of(const Configuration& q) const {
    State state(information_);
    map_.write(q, state.get());
    return state;
  }

  planning::PlanningProblem problem_ = test::post_problem();
  std::stop_source stop_;
  planning::Observer observer_;
  planning::PlanningContext context_{problem_, {}, stop_.get_token(), observer_};
  StateMap map_{planning::make_corridor_space(problem_, planning::CorridorForm::kJoint)};
  ompl::base::SpaceInformationPtr information_ =
      std::make_shared<ompl::base::SpaceInformation>(map_.space());
  MotionCheck motions_{information_, context_, map_};
  StateCheck states_{information_, context_, map_};
  State start_ = state_of(problem_.start);
  State goal_ = state_of(problem_.goal);
};

TEST_F(BesideAPost, AStateIsInvalidWhereTheCheckerFindsACollision) {
  EXPECT_TRUE(states_.isValid(start_.get()));
  EXPECT_FALSE(states_.isValid(state_of(test::planar_configuration(-0.066, 0)).get()));
  EXPECT_EQ(context_.statistics().node_checks, 2U);
}

TEST_F(BesideAPost, AMotionIsValidIfAllOfItIsFree) {
  EXPECT_TRUE(
      motions_.checkMotion(start_.get(), state_of(test::planar_configuration(-0.5, 0.1)).get()));
  EXPECT_FALSE(motions_.checkMotion(start_.get(), goal_.get()));
  EXPECT_EQ(motions_.getValidMotionCount(), 1U);
  EXPECT_EQ(motions_.getInvalidMotionCount(), 1U);
  EXPECT_GT(context_.statistics().edge_checks, 0U);
}

TEST_F(BesideAPost, AMotionThatEndsInCollisionIsNotValid) {
  EXPECT_FALSE(
      motions_.checkMotion(start_.get(), state_of(test::planar_configuration(-0.066, 0)).get()));
  EXPECT_EQ(context_.statistics().edges_tested, 0U) << "an edge may only be asked for free ends";
}

TEST_F(BesideAPost, TheFreePartOfAMotionIsFoundAndIsFree) {
  State end(information_);
  std::pair<ompl::base::State*, double> last(end.get(), -1.0);
  EXPECT_FALSE(motions_.checkMotion(start_.get(), goal_.get(), last));
  EXPECT_GT(last.second, 0.0);
  EXPECT_LT(last.second, 0.5) << "the post stands in the middle";
  const Configuration reached = map_.read(end.get());
  EXPECT_TRUE(reached.isApprox(problem_.start + last.second * (problem_.goal - problem_.start)));
  EXPECT_TRUE(context_.validator().edge_free(problem_.start, reached));
  const double farther = last.second + 1.0 / 32.0;
  EXPECT_FALSE(context_.validator().edge_free(
      problem_.start, problem_.start + farther * (problem_.goal - problem_.start)));
}

TEST_F(BesideAPost, TheFreePartMayBeWrittenOverTheEndOfTheMotion) {
  State apart(information_);
  std::pair<ompl::base::State*, double> expected(apart.get(), 0.0);
  EXPECT_FALSE(motions_.checkMotion(start_.get(), goal_.get(), expected));
  std::pair<ompl::base::State*, double> last(goal_.get(), 0.0);
  EXPECT_FALSE(motions_.checkMotion(start_.get(), goal_.get(), last));
  EXPECT_EQ(last.second, expected.second);
  EXPECT_EQ(goal_, apart);
}

TEST_F(BesideAPost, FreeMotionsAreRememberedBothWays) {
  const Configuration near = test::planar_configuration(-0.5, 0.1);
  EXPECT_FALSE(motions_.known_free(map_.read(start_.get()), near));
  const State end = state_of(near);
  EXPECT_TRUE(motions_.checkMotion(start_.get(), end.get()));
  EXPECT_TRUE(motions_.known_free(map_.read(start_.get()), map_.read(end.get())));
  EXPECT_TRUE(motions_.known_free(map_.read(end.get()), map_.read(start_.get())));
  EXPECT_FALSE(motions_.checkMotion(start_.get(), goal_.get()));
  EXPECT_FALSE(motions_.known_free(map_.read(start_.get()), map_.read(goal_.get())));
}

TEST_F(BesideAPost, OfAFreeMotionThereIsNothingToTell) {
  const State near = state_of(test::planar_configuration(-0.5, 0.1));
  State end = goal_;
  std::pair<ompl::base::State*, double> last(end.get(), 0.25);
  EXPECT_TRUE(motions_.checkMotion(start_.get(), near.get(), last));
  EXPECT_EQ(last.second, 0.25);
  EXPECT_EQ(end, goal_);
}

TEST_F(BesideAPost, NoMotionIsFoundFreeOnceTheRunHasToEnd) {
  stop_.request_stop();
  const State near = state_of(test::planar_configuration(-0.5, 0.1));
  EXPECT_TRUE(states_.isValid(start_.get())) << "else who waits for a valid state waits for ever";
  State end(information_);
  std::pair<ompl::base::State*, double> last(end.get(), -1.0);
  EXPECT_FALSE(motions_.checkMotion(start_.get(), near.get(), last));
  EXPECT_EQ(last.second, 0.0);
  EXPECT_EQ(map_.read(end.get()), problem_.start) << "the beginning of the motion";
}

}  // namespace
}  // namespace handway::planner_ompl
