#include "handway/planning/core/objective.h"

#include "handway/planning/core/plan_result.h"
#include "handway_test/planar_problems.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace handway::planning {
namespace {

/// The flat arm with a hand whose fingers spread together in the subspace, and the thumb is free.
class FlatArm : public testing::Test {
 protected:
  FlatArm() {
    sampling::PmdBasis basis = test::planar_hand_basis();
    basis.directions.resize(1);
    problem_.basis = std::make_shared<const sampling::PmdBasis>(std::move(basis));
  }

  // One finger spread by `apart` rad more than the other: outside of the subspace.
  [[nodiscard]] static Configuration posture(double shoulder, double apart) {
    return test::planar_configuration(shoulder, 0.0, 0.0, 0.6 + 0.5 * apart, 0.6 - 0.5 * apart);
  }
  [[nodiscard]] double distance(const Configuration& q) const {
    return Objective(problem_, {}).point(q).distance();
  }

  PlanningProblem problem_ = test::open_problem();
};

TEST_F(FlatArm, CostsItsLengthAlone) {
  Objective shortest(problem_, {});
  const Configuration from = posture(-0.4, 0.0);
  const Configuration to = posture(0.4, 0.2);
  EXPECT_NEAR(shortest.cost(Path{{from, to}}), normalised_distance(problem_.model(), from, to),
              1e-12);
  EXPECT_NEAR(shortest.cost(Path{{from, 0.3 * from + 0.7 * to, to}}),
              shortest.cost(Path{{from, to}}), 1e-12)
      << "a waypoint on a motion changes nothing";
}

TEST_F(FlatArm, CostsMoreWithTheHandOutsideOfTheSubspace) {
  Objective human(problem_, {.human_likeness = 2.0});
  const Path inside{{posture(-0.4, 0.0), posture(0.4, 0.0)}};
  const Path outside{{posture(-0.4, 0.3), posture(0.4, 0.3)}};
  const double length =
      normalised_distance(problem_.model(), inside.waypoints[0], inside.waypoints[1]);
  EXPECT_NEAR(human.cost(inside), length, 1e-9);
  EXPECT_NEAR(human.cost(outside), length + 2.0 * distance(outside.waypoints[0]), 1e-9);
}

TEST_F(FlatArm, MayBeAsManyTimesLongerForHumanLikenessOnShortAndLongMotions) {
  const auto weight = [&](double share) {
    PlanningProblem part = problem_;
    part.goal = part.start + share * (problem_.goal - problem_.start);
    return ObjectiveSettings{}.weights(part).human_likeness;
  };
  const double whole = normalised_distance(problem_.model(), problem_.start, problem_.goal);
  ASSERT_GT(0.8 * whole, 0.25);
  EXPECT_NEAR(weight(0.8), 0.8 * weight(1.0), 1e-9);
  EXPECT_EQ(weight(1e-3), weight(1e-4));
}

TEST_F(FlatArm, CostsAtMostTheTimeOfItsSlowestJoint) {
  Objective fastest(problem_, {.length = 0.0, .duration = 1.0});
  const Configuration from = posture(-0.4, 0.0);
  const Configuration to = posture(0.4, 0.0);
  const double velocity = problem_.model().variable(problem_.joints.arm.front()).limits.velocity;
  const double limit = std::isfinite(velocity) && velocity > 0.0 ? velocity : 1.0;
  EXPECT_NEAR(fastest.cost(Path{{from, to}}), 0.8 / limit, 1e-12);
}

TEST_F(FlatArm, GoesTowardsTheSubspaceWithTheArmAsItIs) {
  const Objective objective(problem_, {});
  const Objective::Point at = objective.point(posture(0.2, 0.3));
  const Objective::Point half = objective.towards_subspace(at, 0.5);
  EXPECT_NEAR(half.distance(), 0.5 * at.distance(), 1e-9);
  EXPECT_NEAR(objective.towards_subspace(at, 1.0).distance(), 0.0, 1e-9);
  for (const int v : problem_.joints.arm) {
    EXPECT_NEAR(half.q[v], at.q[v], 1e-12);
  }
  EXPECT_NEAR(objective.moved_along_subspace(half, Eigen::Vector2d(0.1, 0.1)).distance(),
              half.distance(), 1e-9);
}

TEST_F(FlatArm, KnowsWhatTheEndsForce) {
  const Configuration start = posture(-0.4, 0.3);
  const Configuration goal = posture(0.4, 0.3);
  const Path forced{{start, posture(-0.4, 0.0), posture(0.4, 0.0), goal}};
  const PathQuality quality = path_quality(problem_, forced);
  ASSERT_TRUE(quality.human_likeness);
  EXPECT_NEAR(quality.human_likeness->mean, quality.human_likeness->forced, 1e-3);
  EXPECT_EQ(quality.human_likeness->share_beyond, 0.0) << "the ends' stretches are excepted";
  EXPECT_LT(quality.human_likeness->largest, kNearSubspace);

  const PathQuality straight = path_quality(problem_, Path{{start, goal}});
  EXPECT_NEAR(straight.human_likeness->mean, distance(start), 1e-9);
  EXPECT_NEAR(straight.human_likeness->largest, distance(start), 1e-9);
  EXPECT_NEAR(straight.human_likeness->share_beyond, 1.0, 1e-9);
  EXPECT_LT(straight.length, quality.length);
}

TEST_F(FlatArm, MeasuresHowFarAPostureIsInTheRecordedDistribution) {
  sampling::PmdBasis basis = *problem_.basis;
  basis.directions.front().variance = 0.04;
  problem_.basis = std::make_shared<const sampling::PmdBasis>(basis);
  const Objective objective(problem_, {});
  const Objective::Point middle = objective.towards_subspace(objective.point(problem_.start), 1.0);
  const Configuration q =
      objective.with_hand(middle, objective.point_of_joints(Eigen::VectorXd::Constant(5, 0.5))).q;
  const Configuration spread =
      objective.moved_along_subspace(objective.point(q), Eigen::Vector2d(0.0, 0.4 / 0.7)).q;
  EXPECT_NEAR(path_quality(problem_, Path{{q, q}}).human_likeness->mahalanobis_mean, 0.0, 1e-9);
  EXPECT_NEAR(path_quality(problem_, Path{{spread, spread}}).human_likeness->mahalanobis_mean,
              0.4 / 0.2, 1e-9);
}

TEST_F(FlatArm, HasNoHumanLikenessWithoutABasis) {
  problem_.basis = nullptr;
  const PathQuality quality = path_quality(problem_, Path{{problem_.start, problem_.goal}});
  EXPECT_FALSE(quality.human_likeness);
  EXPECT_GT(quality.length, 0.0);
  EXPECT_GT(quality.duration, 0.0);
  EXPECT_EQ(ObjectiveSettings().weights(problem_), ObjectiveWeights{})
      << "human-like is shortest where there is no basis";
  EXPECT_THROW(static_cast<void>(path_quality(problem_, {})), std::invalid_argument);
}

TEST_F(FlatArm, IsClearOfEverythingInAnEmptyCellHoweverNearItsFingersAre) {
  const Path path{{problem_.start, problem_.goal}};
  const PathQuality quality = path_quality(problem_, path);
  EXPECT_EQ(quality.least_clearance, kFarClearance);
  EXPECT_NEAR(quality.mean_clearance, kFarClearance, 1e-12);
  EXPECT_NEAR(Objective(problem_, {.clearance = 4.0}).cost(path), quality.length, 1e-9);
}

TEST(Clearance, IsTheDistanceFromObstacles) {
  geometric::Scene scene = test::scene_of(test::gantry(geometric::Box{{0.04, 0.04, 0.04}}));
  scene.start = Eigen::Vector3d(-0.5, 0.0, 0.0);
  scene.goal = Eigen::Vector3d(0.5, 0.0, 0.0);
  test::add_object(scene, "plate", geometric::Box{{2.0, 0.02, 1.0}},
                   Eigen::Vector3d(0.0, 0.06, 0.0));
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr);
  const PathQuality quality = path_quality(problem, Path{{problem.start, problem.goal}});
  EXPECT_NEAR(quality.least_clearance, 0.03, 1e-6);
  EXPECT_NEAR(quality.mean_clearance, 0.03, 1e-6);
}

}  // namespace
}  // namespace handway::planning
