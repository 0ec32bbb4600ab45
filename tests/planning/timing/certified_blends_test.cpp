#include "handway/planning/timing/blended_path.h"
#include "handway_test/input_errors.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace handway::planning {
namespace {

using test::planar_configuration;
using testing::AllOf;
using testing::HasSubstr;

double least_clearance(const PlanningProblem& problem, const BlendedPath& path) {
  const auto checker = problem.checker->clone();
  double least = 1.0;
  for (const PathPiece& piece : path.pieces()) {
    for (int i = 0; i <= 200; ++i) {
      least = std::min(
          least,
          find_clearance(*checker, piece.derivative(0, piece.length * i / 200), least).distance);
    }
  }
  return least;
}

TEST(CertifiedBlends, RoundsCornersInTheOpen) {
  const PlanningProblem problem = test::open_problem();
  const Path path = {{problem.start, planar_configuration(0.2, 0.3, 0.1), problem.goal}};
  const BlendResult result = certified_blends(problem, path);
  ASSERT_TRUE(result.path) << result.fault;
  EXPECT_EQ(result.arcs, 1);
  EXPECT_EQ(result.reduced, 0);
  EXPECT_EQ(result.stops, 0);
  EXPECT_NEAR(result.largest_deviation, 0.05, 1e-9);
}

// A ball that goes around a corner, and a rod that stands inside it.
TEST(CertifiedBlends, ShrinksAnArcThatWouldCollide) {
  geometric::Scene scene = test::scene_of(test::gantry(geometric::Sphere{0.05}));
  test::add_object(scene, "rod", geometric::Cylinder{0.02, 0.5}, Eigen::Vector3d(-0.1, 0.1, 0.0));
  scene.start = Eigen::Vector3d(-0.5, 0.0, 0.0);
  scene.goal = Eigen::Vector3d(0.0, 0.5, 0.0);
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(scene), nullptr);
  const Path path = {{problem.start, Eigen::Vector3d(0.0, 0.0, 0.0), problem.goal}};
  BlendOptions options;
  options.deviation = 1.0;  // the largest that the edges leave room for: 0.10 m
  const BlendResult result = certified_blends(problem, path, options);
  ASSERT_TRUE(result.path) << result.fault;
  EXPECT_EQ(result.reduced, 1);
  EXPECT_EQ(result.arcs, 1);
  EXPECT_NEAR(result.largest_deviation, 0.5 * 0.25 * (std::sqrt(2.0) - 1.0), 1e-9);
  EXPECT_NEAR(least_clearance(problem, *result.path), 0.0196, 1e-3);
  options.arc_clearance = 0.08;  // more than the corner keeps
  const BlendResult none = certified_blends(problem, path, options);
  ASSERT_TRUE(none.path) << none.fault;
  EXPECT_EQ(none.arcs, 0);
  EXPECT_EQ(none.stops, 1);
}

TEST(CertifiedBlends, StopsAtEveryWaypointWhenAskedTo) {
  const PlanningProblem problem = test::open_problem();
  const Path path = {{problem.start, planar_configuration(0.2, 0.3, 0.1), problem.goal}};
  BlendOptions options;
  options.deviation = 0.0;
  const BlendResult result = certified_blends(problem, path, options);
  ASSERT_TRUE(result.path) << result.fault;
  EXPECT_EQ(result.arcs, 0);
  EXPECT_EQ(result.stops, 1);
}

TEST(CertifiedBlends, NamesWhatAPathCollidesWith) {
  const PlanningProblem problem = test::post_problem();
  const BlendResult result = certified_blends(problem, {{problem.start, problem.goal}});
  EXPECT_FALSE(result.path);
  EXPECT_THAT(result.fault, AllOf(HasSubstr("post"), HasSubstr("between waypoints 1 and 2")));
}

TEST(CertifiedBlends, RefusesWaypointsThatAreNoConfigurations) {
  const PlanningProblem problem = test::open_problem();
  const auto refusal = [&](const Path& path) {
    return test::refusal_of([&] { static_cast<void>(certified_blends(problem, path)); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("no waypoints"));
  EXPECT_THAT(refusal({{problem.start, Eigen::Vector2d(0, 0)}}),
              AllOf(HasSubstr("waypoint 2"), HasSubstr("2 values")));
  EXPECT_THAT(refusal({{problem.start, planar_configuration(9.0, 0)}}),
              AllOf(HasSubstr("joint shoulder"), HasSubstr("9"), HasSubstr("2.5")));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal({{planar_configuration(0, nan)}}), HasSubstr("joint elbow"));
}

}  // namespace
}  // namespace handway::planning
