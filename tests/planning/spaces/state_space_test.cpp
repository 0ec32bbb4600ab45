#include "handway/planning/spaces/state_space.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/spaces/target_sampler.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stop_token>

namespace handway::planning {
namespace {

constexpr std::uint64_t kDraws = 500;
constexpr int kAllAxes = 100;
constexpr double kPi = std::numbers::pi;

Configuration there_and_back(const StateSpace& space, const Configuration& q) {
  return space.configuration(space.coordinates(q), q).value();
}

TEST(JointSpace, IsTheUnitCubeOfNormalisedJoints) {
  const PlanningProblem problem = test::open_problem();
  const auto space = make_corridor_space(problem, CorridorForm::kJoint);
  EXPECT_TRUE(space->coordinates(problem.model().upper()).isApprox(space->upper()));
  const Configuration q = test::planar_configuration(0.123, -0.456, 0.05, 0.3, 0.2);
  EXPECT_TRUE(there_and_back(*space, q).isApprox(q, 1e-14));
  EXPECT_NEAR((space->coordinates(problem.start) - space->coordinates(problem.goal)).norm(),
              normalised_distance(problem.model(), problem.start, problem.goal), 1e-12);
}

TEST(JointSpace, HasACorridorWithinTheLimitsOfTheJoints) {
  const PlanningProblem problem = test::open_problem();
  const auto space = make_corridor_space(problem, CorridorForm::kJoint);
  sampling::RandomStream stream(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd arm = space->corridor_point(stream.uniform(), 0.7, stream.uniform(2));
    ASSERT_GE(arm.minCoeff(), 0.0);
    ASSERT_LE(arm.maxCoeff(), 1.0);
  }
}

TEST(JointSpace, HasTheSmallestPowerOfTwoOfStepsThatIsFineEnough) {
  const PlanningProblem problem = test::open_problem();
  const auto space = make_corridor_space(problem, CorridorForm::kJoint);
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(space->corridor_dimension(), 0.5);
  const double length =
      (space->corridor_point(1.0, 0.1, middle) - space->corridor_point(0.0, 0.1, middle)).norm();
  EXPECT_EQ(space->steps(1.01 * length), 1);
  EXPECT_EQ(space->steps(0.9 * length), 2);
  EXPECT_EQ(space->steps(0.2 * length), 8);
  EXPECT_EQ(space->steps(0.0), 1 << 20);
}

TEST(JointSpace, ReachesTheFacesOfItsCubes) {
  const PlanningProblem problem = test::open_problem();
  const auto space = make_corridor_space(problem, CorridorForm::kJoint);
  const Eigen::VectorXd centre = space->corridor_point(0.5, 0.01, Eigen::Vector2d(0.5, 0.5));
  EXPECT_TRUE(space->corridor_point(0.5, 0.01, Eigen::Vector2d(0.0, 1.0))
                  .isApprox(centre + Eigen::Vector2d(-0.01, 0.01), 1e-12));
}

TEST(JointSpace, GoesOnBeyondATurnOfAContinuousJoint) {
  const PlanningProblem problem = test::endless_problem(3.0, 3.5);
  const auto space = make_corridor_space(problem, CorridorForm::kJoint);
  const Eigen::VectorXd start = space->coordinates(problem.start);
  const Eigen::VectorXd goal = space->coordinates(test::planar_configuration(3.5 - 4 * kPi, 0.0));
  EXPECT_NEAR(space->periods().difference(start, goal).norm(), 0.5 / (2 * kPi), 1e-12);
  EXPECT_GT(space->corridor_point(1.0, 0.1, Eigen::Vector2d(1.0, 0.5))[0], 1.1);
}

TEST(ControlSpace, HasTheArmsTheFreeJointsTheDirectionsAndTheEndsDeviations) {
  const PlanningProblem problem = test::open_problem();
  const auto space = make_control_space(problem, 4, 0.4);
  EXPECT_EQ(space->dimension(),
            static_cast<int>(problem.joints.arm.size()) + problem.basis->dimension() + 2);
}

TEST(ControlSpace, ReachesStartAndGoalOutsideOfTheSubspace) {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(-0.5, 0.1, 0.02, 0.3, 0.7);
  problem.goal = test::planar_configuration(0.4, 0.2, 0.0, 0.9, 0.1);
  const auto space = make_control_space(problem, 1, 0.4);
  EXPECT_TRUE(there_and_back(*space, problem.start).isApprox(problem.start, 1e-9));
  EXPECT_TRUE(there_and_back(*space, problem.goal).isApprox(problem.goal, 1e-9));
}

TEST(ControlSpace, MovesStraightInTheJointsWhereItMovesStraight) {
  PlanningProblem problem = test::open_problem();
  problem.start = test::planar_configuration(-0.5, 0.1, 0.0, 0.3, 0.5);
  problem.goal = test::planar_configuration(0.4, 0.2, 0.0, 0.4, 0.3);
  const auto space = make_control_space(problem, 1, 0.4);
  const Eigen::VectorXd middle =
      0.5 * (space->coordinates(problem.start) + space->coordinates(problem.goal));
  EXPECT_TRUE(space->configuration(middle, problem.start)
                  ->isApprox(0.5 * (problem.start + problem.goal), 1e-12));
}

TEST(ControlSpace, TakesAnArmThatStaysWhereItIs) {
  PlanningProblem problem = test::open_problem();
  problem.goal = problem.start;
  problem.goal(problem.joints.hand).array() += 0.1;
  const auto space = make_control_space(problem, 4, 0.4);
  EXPECT_TRUE(there_and_back(*space, problem.goal).isApprox(problem.goal, 1e-9));
}

/// Fixture of the targets that searches of the flat arm sample.
class TargetsOfTheFlatArm : public testing::Test {
 protected:
  Configuration draw(TargetSampler& targets, std::uint64_t sample) {
    const int end = static_cast<int>(sample % 2);
    const Eigen::VectorXd x = targets.draw(sample, end, kAllAxes).coordinates;
    return targets.space().configuration(x, problem_.start).value();
  }

  PlanningProblem problem_ = test::open_problem();
  Observer observer_;
  std::stop_source stop_;
};

TEST_F(TargetsOfTheFlatArm, HaveTheHandInItsSubspaceAndTheArmInItsCorridor) {
  const double rho = 0.02;
  PlanningContext context(problem_, {}, stop_.get_token(), observer_);
  const TargetRegion region{.near_ends = 0.0, .rho_a = rho, .rho_max = rho, .max_pmds = 1};
  TargetSampler targets(context, region, HandSpace::kPrincipalDirections, 1);
  sampling::PmdBasis basis = *problem_.basis;
  basis.directions.resize(1);
  const Eigen::VectorXd start =
      geometric::normalised(problem_.model(), problem_.start)(problem_.joints.arm);
  const Eigen::VectorXd goal =
      geometric::normalised(problem_.model(), problem_.goal)(problem_.joints.arm);
  const Eigen::VectorXd along = (goal - start).normalized();
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const Eigen::VectorXd joints = geometric::normalised(problem_.model(), draw(targets, i));
    const Eigen::VectorXd posture = joints(problem_.joints.hand);
    const bool at_a_limit = (posture.array() < 1e-9 || posture.array() > 1.0 - 1e-9).any();
    EXPECT_TRUE(at_a_limit || sampling::distance_to_subspace(basis, posture) < 1e-9);
    const Eigen::VectorXd off = joints(problem_.joints.arm) - start;
    EXPECT_LE((off - off.dot(along) * along).norm(),
              rho * std::sqrt(static_cast<double>(problem_.joints.arm.size())) + 1e-9);
  }
}

TEST_F(TargetsOfTheFlatArm, KeepThePosturesOfTheEndsInHalfOfTheDrawsAroundThem) {
  problem_.start = test::planar_configuration(-0.5, 0.1, 0.02, 0.3, 0.7);
  PlanningContext context(problem_, {}, stop_.get_token(), observer_);
  const TargetRegion region{.near_ends = 1.0, .max_pmds = 1};
  TargetSampler targets(context, region, HandSpace::kPrincipalDirections, 1);
  int as_at_start = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    as_at_start +=
        draw(targets, i)(problem_.joints.hand).isApprox(problem_.start(problem_.joints.hand), 1e-9)
            ? 1
            : 0;
  }
  EXPECT_NEAR(as_at_start, kDraws / 4.0, 50.0);
}

// This holds for half of the samples; the others have the arm next to the straight motion.
TEST_F(TargetsOfTheFlatArm, AreAnywhereOnceTheCorridorWasWidenedInVain) {
  PlanningContext context(problem_, {}, stop_.get_token(), observer_);
  const TargetRegion region{.near_ends = 0.0,
                            .rho_a = 0.001,
                            .rho_max = 0.001,
                            .samples_per_width = kDraws / 2,
                            .anywhere = 0.5};
  TargetSampler targets(context, region, HandSpace::kPrincipalDirections, 1);
  const auto far_from_corridor = [&](std::uint64_t first) {
    int count = 0;
    for (std::uint64_t i = first; i < first + kDraws; ++i) {
      const Configuration q = draw(targets, i);
      const auto arm = [&](const Configuration& c) -> Eigen::VectorXd {
        return geometric::normalised(problem_.model(), c)(problem_.joints.arm);
      };
      const Eigen::VectorXd along = (arm(problem_.goal) - arm(problem_.start)).normalized();
      const Eigen::VectorXd off = arm(q) - arm(problem_.start);
      count += (off - off.dot(along) * along).norm() > 0.01 ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(far_from_corridor(0), 0);
  EXPECT_NEAR(far_from_corridor(kDraws), 0.5 * kDraws, 0.1 * kDraws);
}

TEST_F(TargetsOfTheFlatArm, StayWithinTheLimits) {
  PlanningContext context(problem_, {}, stop_.get_token(), observer_);
  const TargetRegion region;
  for (const HandSpace hand : {HandSpace::kAllJoints, HandSpace::kPrincipalDirections}) {
    TargetSampler targets(context, region, hand, 1);
    for (std::uint64_t i = 0; i < kDraws; ++i) {
      const Eigen::VectorXd joints = geometric::normalised(problem_.model(), draw(targets, i));
      EXPECT_GE(joints.minCoeff(), -1e-12);
      EXPECT_LE(joints.maxCoeff(), 1.0 + 1e-12);
    }
  }
}

TEST_F(TargetsOfTheFlatArm, AreChosenAsTheParameterSays) {
  problem_ = test::post_problem();
  PlanningContext context(problem_, {}, stop_.get_token(), observer_);
  const TargetRegion region;
  std::vector<Configuration> first;
  for (std::size_t kind = 0; kind < sampling::sampler_names().size(); ++kind) {
    context.set_sampler(static_cast<sampling::SamplerKind>(kind));
    TargetSampler targets(context, region, HandSpace::kPrincipalDirections, 1);
    for (const Configuration& other : first) {
      EXPECT_NE(draw(targets, 1), other);
    }
    first.push_back(draw(targets, 1));
  }
}

}  // namespace
}  // namespace handway::planning
