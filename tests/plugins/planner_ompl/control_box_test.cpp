#include "control_box.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using planning::PlanningProblem;
using BoxState = ompl::base::ScopedState<ompl::base::RealVectorStateSpace>;

constexpr std::uint64_t kDraws = 500;

Configuration there_and_back(const ControlBox& box, const Configuration& q) {
  BoxState state(box.space());
  box.write(q, state.get());
  return box.read(state.get());
}

Configuration at(const ControlBox& box, const Eigen::VectorXd& x) {
  BoxState state(box.space());
  for (unsigned int i = 0; i < box.space()->getDimension(); ++i) {
    state[i] = x[static_cast<Eigen::Index>(i)];
  }
  return box.read(state.get());
}

TEST(ControlBox, HasTheArmsTheFreeJointsTheDirectionsAndTheEndsDeviations) {
  const PlanningProblem problem = test::open_problem();
  const ControlBox box(problem, {});
  const std::size_t hand = problem.basis->free_joints.size() + problem.basis->directions.size();
  EXPECT_GE(box.space()->getDimension(), problem.arm.size() + hand);
  EXPECT_LE(box.space()->getDimension(), problem.arm.size() + hand + 2);
}

TEST(ControlBox, GivesStartAndGoalBackToTheBit) {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(-0.5, 0.1, 0.02, 0.3, 0.7);
  problem.goal = test::planar_configuration(0.4, 0.2, 0.0, 0.9, 0.1);
  const ControlBox box(problem, {.max_pmds = 1});
  EXPECT_EQ(there_and_back(box, problem.start), problem.start);
  EXPECT_EQ(there_and_back(box, problem.goal), problem.goal);
}

TEST(ControlBox, MovesStraightInTheJointsWhereItMovesStraight) {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(-0.5, 0.1, 0.0, 0.3, 0.5);
  problem.goal = test::planar_configuration(0.4, 0.2, 0.0, 0.4, 0.3);
  const ControlBox box(problem, {.max_pmds = 1});
  BoxState from(box.space());
  BoxState to(box.space());
  BoxState middle(box.space());
  box.write(problem.start, from.get());
  box.write(problem.goal, to.get());
  box.space()->interpolate(from.get(), to.get(), 0.5, middle.get());
  EXPECT_TRUE(box.read(middle.get()).isApprox(0.5 * (problem.start + problem.goal), 1e-12));
}

TEST(ControlBox, MeasuresTheArmAsNormalisedJoints) {
  PlanningProblem problem = test::open_problem();
  Eigen::VectorXd joints = geometric::normalised(problem.model(), problem.start);
  joints(problem.hand) = sampling::map_to_posture(
      *problem.basis, Eigen::VectorXd::Constant(problem.basis->dimension(), 0.5));
  problem.start = geometric::denormalised(problem.model(), joints);
  problem.goal = problem.start;
  problem.goal(problem.arm) = test::planar_configuration(0.5, -0.3)(problem.arm);
  const ControlBox box(problem, {});
  BoxState from(box.space());
  BoxState to(box.space());
  box.write(problem.start, from.get());
  box.write(problem.goal, to.get());
  EXPECT_NEAR(box.space()->distance(from.get(), to.get()),
              planning::normalised_distance(problem.model(), problem.start, problem.goal), 1e-12);
}

TEST(ControlBox, DrawsWithinTheBoxAndTheLimits) {
  const PlanningProblem problem = test::post_problem();
  const ControlBox box(problem, {});
  sampling::RandomStream stream(1);
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const Configuration q = at(box, box.draw(stream, i));
    EXPECT_TRUE((q.array() >= problem.model().lower().array()).all());
    EXPECT_TRUE((q.array() <= problem.model().upper().array()).all());
  }
}

TEST(ControlBox, DrawsTheHandFromItsSubspaceAndTheArmFromItsCorridor) {
  const PlanningProblem problem = test::open_problem();
  const double rho = 0.02;
  const ControlBox box(problem,
                       {.target = {.near_ends = 0.0, .rho_a = rho, .rho_max = rho}, .max_pmds = 1});
  sampling::PmdBasis basis = *problem.basis;
  basis.directions.resize(1);
  const Eigen::VectorXd start = geometric::normalised(problem.model(), problem.start)(problem.arm);
  const Eigen::VectorXd goal = geometric::normalised(problem.model(), problem.goal)(problem.arm);
  const Eigen::VectorXd along = (goal - start).normalized();
  sampling::RandomStream stream(1);
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const Eigen::VectorXd joints =
        geometric::normalised(problem.model(), at(box, box.draw(stream, i)));
    const Eigen::VectorXd posture = joints(problem.hand);
    const bool at_a_limit = (posture.array() < 1e-9 || posture.array() > 1.0 - 1e-9).any();
    EXPECT_TRUE(at_a_limit || sampling::distance_to_subspace(basis, posture) < 1e-9);
    const Eigen::VectorXd off = joints(problem.arm) - start;
    EXPECT_LE((off - off.dot(along) * along).norm(),
              rho * std::sqrt(static_cast<double>(problem.arm.size())) + 1e-9);
  }
}

TEST(ControlBox, DrawsAroundTheEndsWithTheirPostures) {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(-0.5, 0.1, 0.02, 0.3, 0.7);
  const ControlBox box(problem, {.target = {.near_ends = 1.0}, .max_pmds = 1});
  sampling::RandomStream stream(1);
  int as_at_start = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const Configuration q = at(box, box.draw(stream, i));
    as_at_start += q(problem.hand).isApprox(problem.start(problem.hand), 1e-9) ? 1 : 0;
  }
  EXPECT_NEAR(as_at_start, kDraws / 4.0, 50.0);
}

TEST(ControlBox, TakesAnArmThatStaysWhereItIs) {
  PlanningProblem problem = test::open_problem();
  problem.goal = problem.start;
  problem.goal(problem.hand).array() += 0.1;
  const ControlBox box(problem, {});
  EXPECT_EQ(there_and_back(box, problem.goal), problem.goal);
}

}  // namespace
}  // namespace handway::planner_ompl
