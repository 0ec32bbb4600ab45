#include "joint_cube.h"

#include "handway/geometric/robot/robot_model.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using planning::PlanningProblem;

Configuration there_and_back(const JointCube& cube, const Configuration& q) {
  ompl::base::State* state = cube.space()->allocState();
  cube.write(q, state);
  const Configuration back = cube.read(state);
  cube.space()->freeState(state);
  return back;
}

TEST(JointCube, HasADimensionForEveryJointAndItsLimitsAsCorners) {
  const PlanningProblem problem = test::open_problem();
  const JointCube cube(problem);
  EXPECT_EQ(cube.space()->getDimension(), 5U);
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> state(cube.space());
  cube.write(problem.model().upper(), state.get());
  for (unsigned int i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(state->values[i], 1.0);
  }
  EXPECT_TRUE(cube.read(state.get()).isApprox(problem.model().upper()));
}

TEST(JointCube, GivesConfigurationsBack) {
  const PlanningProblem problem = test::open_problem();
  const Configuration q = test::planar_configuration(0.123, -0.456, 0.05, 0.3, 0.2);
  EXPECT_TRUE(there_and_back(JointCube(problem), q).isApprox(q, 1e-14));
}

TEST(JointCube, GivesStartAndGoalBackToTheBit) {
  PlanningProblem problem = test::open_problem();
  problem.goal[0] = problem.model().upper()[0] + 1e-10;  // as roundings of a file leave it
  const JointCube cube(problem);
  EXPECT_EQ(there_and_back(cube, problem.start), problem.start);
  EXPECT_EQ(there_and_back(cube, problem.goal), problem.goal);
}

TEST(JointCube, KeepsStatesWithinTheBoundsThatOmplChecks) {
  const PlanningProblem problem = test::open_problem();
  const JointCube cube(problem);
  ompl::base::ScopedState<> state(cube.space());
  cube.write(problem.model().upper() + Configuration::Constant(5, 1e-9), state.get());
  EXPECT_TRUE(cube.space()->satisfiesBounds(state.get()));
}

}  // namespace
}  // namespace handway::planner_ompl
