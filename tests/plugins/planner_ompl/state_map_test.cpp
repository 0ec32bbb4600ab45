#include "state_map.h"

#include "handway/geometric/robot/robot_model.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using planning::PlanningProblem;
using State = ompl::base::ScopedState<ompl::base::RealVectorStateSpace>;

StateMap joints_of(const PlanningProblem& problem) {
  return StateMap(planning::make_corridor_space(problem, planning::CorridorForm::kJoint));
}

Configuration there_and_back(const StateMap& map, const Configuration& q) {
  State state(map.space());
  map.write(q, state.get());
  return map.read(state.get());
}

TEST(StateMap, HasADimensionForEveryJointAndItsLimitsAsCorners) {
  const PlanningProblem problem = test::open_problem();
  const StateMap map = joints_of(problem);
  EXPECT_EQ(map.space()->getDimension(), 5U);
  State state(map.space());
  map.write(problem.model().upper(), state.get());
  for (unsigned int i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(state->values[i], 1.0);
  }
  EXPECT_TRUE(map.read(state.get()).isApprox(problem.model().upper()));
}

TEST(StateMap, GivesConfigurationsBack) {
  const PlanningProblem problem = test::open_problem();
  const Configuration q = test::planar_configuration(0.123, -0.456, 0.05, 0.3, 0.2);
  EXPECT_TRUE(there_and_back(joints_of(problem), q).isApprox(q, 1e-14));
}

TEST(StateMap, GivesStartAndGoalBackToTheBit) {
  PlanningProblem problem = test::open_problem();
  problem.goal[0] = problem.model().upper()[0] + 1e-10;  // as roundings of a file leave it
  const StateMap joints = joints_of(problem);
  const StateMap controls(planning::make_control_space(problem, 1, 0.4));
  for (const StateMap* map : {&joints, &controls}) {
    EXPECT_EQ(there_and_back(*map, problem.start), problem.start);
    EXPECT_EQ(there_and_back(*map, problem.goal), problem.goal);
  }
}

TEST(StateMap, KeepsStatesWithinTheBoundsThatOmplChecks) {
  const PlanningProblem problem = test::open_problem();
  const StateMap map = joints_of(problem);
  State state(map.space());
  map.write(problem.model().upper() + Configuration::Constant(5, 1e-9), state.get());
  EXPECT_TRUE(map.space()->satisfiesBounds(state.get()));
}

TEST(StateMap, LeavesOutCoordinatesWithoutExtent) {
  PlanningProblem problem = test::open_problem();
  Eigen::VectorXd joints = planning::make_corridor_space(problem, planning::CorridorForm::kJoint)
                               ->coordinates(problem.start);
  joints.tail(static_cast<Eigen::Index>(problem.joints.hand.size())) = sampling::map_to_posture(
      *problem.basis, Eigen::VectorXd::Constant(problem.basis->dimension(), 0.5));
  problem.start = *planning::make_corridor_space(problem, planning::CorridorForm::kJoint)
                       ->configuration(joints, problem.start);
  problem.goal(problem.joints.hand) = problem.start(problem.joints.hand);
  const int all = planning::make_control_space(problem, 13, 0.4)->dimension();
  const StateMap map(planning::make_control_space(problem, 13, 0.4));
  EXPECT_EQ(map.space()->getDimension(), static_cast<unsigned int>(all - 2))
      << "start and goal are in the subspace: they have no deviation";
}

}  // namespace
}  // namespace handway::planner_ompl
