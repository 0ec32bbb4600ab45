/// Questions that have an answer on paper, asked of every checker.
#include "handway/geometric/collision/collision_checker.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace handway::geometric {
namespace {

using test::add_object;
using test::scene_of;

using Make = std::function<std::unique_ptr<CollisionChecker>(const Scene&)>;

template <typename Checker>
std::unique_ptr<CollisionChecker> make(const Scene& scene) {
  return std::make_unique<Checker>(std::make_shared<const CollisionWorld>(scene));
}

struct Kind {
  std::string name;
  Make make;
};

class EveryChecker : public testing::TestWithParam<Kind> {
 protected:
  static std::unique_ptr<CollisionChecker> checker(const Scene& scene) {
    return GetParam().make(scene);
  }
};

// A probe that is asked against one obstacle at the origin.
Scene probe_and(const Shape& probe, const Shape& obstacle) {
  Scene scene = scene_of(test::gantry(probe));
  add_object(scene, "obstacle", obstacle, Pose::Identity());
  return scene;
}

TEST_P(EveryChecker, MeasuresBoxesExactly) {
  const auto boxes = checker(probe_and(Box{{0.2, 0.2, 0.2}}, Box{{0.4, 0.4, 0.4}}));
  const auto distance = [&](double x, double y, double z) {
    return find_clearance(*boxes, Eigen::Vector3d(x, y, z)).distance;
  };
  EXPECT_NEAR(distance(0.5, 0, 0), 0.2, 1e-12);                                 // faces
  EXPECT_NEAR(distance(0.6, 0.7, 0), std::hypot(0.3, 0.4), 1e-12);              // edges
  EXPECT_NEAR(distance(0.6, -0.7, 0.9), std::sqrt(0.09 + 0.16 + 0.36), 1e-12);  // corners
  EXPECT_NEAR(distance(0.3 + 1e-6, 0, 0), 1e-6, 1e-12);
  EXPECT_EQ(distance(0.25, 0, 0), 0.0);
}

TEST_P(EveryChecker, MeasuresSpheresWithinTheirTessellation) {
  constexpr double kRadius = 0.1;
  constexpr double kLarger = 0.2;
  const auto spheres = checker(probe_and(Sphere{kRadius}, Sphere{kLarger}));
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.3, 0.4, 0.2), Eigen::Vector3d(-0.1, 0, 0.31),
        Eigen::Vector3d(-0.2, -0.15, 0.2)}) {
    const double exact = p.norm() - kRadius - kLarger;
    const double found = find_clearance(*spheres, p).distance;
    EXPECT_LE(found, exact + 1e-12) << "the solid must be inside its triangles";
    EXPECT_GE(found, exact - 2.0 * kRoundTolerance);
  }
}

TEST_P(EveryChecker, TellsATouchToANanometre) {
  const auto boxes = checker(probe_and(Box{{0.2, 0.2, 0.2}}, Box{{0.4, 0.4, 0.4}}));
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    EXPECT_FALSE(boxes->first_collision(Eigen::Vector3d(0.3 + gap, 0.01, 0.02))) << gap;
    EXPECT_TRUE(boxes->first_collision(Eigen::Vector3d(0.3 - gap, 0.01, 0.02))) << gap;
  }
}

TEST_P(EveryChecker, AnswersTheToleranceQuery) {
  const auto boxes = checker(probe_and(Box{{0.2, 0.2, 0.2}}, Box{{0.4, 0.4, 0.4}}));
  const Eigen::Vector3d q(0.35, 0, 0);  // 5 cm
  EXPECT_TRUE(is_closer_than(*boxes, q, 0.0501));
  EXPECT_FALSE(is_closer_than(*boxes, q, 0.0499));
  EXPECT_TRUE(is_closer_than(*boxes, Eigen::Vector3d(0.25, 0, 0), 1e-12)) << "they touch";
  EXPECT_FALSE(is_closer_than(*boxes, q, 0.0));
}

TEST_P(EveryChecker, KeepsWhatItPromisesOfDistances) {
  const auto boxes = checker(probe_and(Box{{0.2, 0.2, 0.2}}, Box{{0.4, 0.4, 0.4}}));
  for (const double gap : {0.001, 0.01, 0.1, 0.5}) {
    boxes->place(Eigen::Vector3d(0.3 + gap, 0.05, -0.02));
    for (const double enough : {1e-4, 0.005, 0.05, 0.2, 10.0}) {
      const double distance = boxes->pair_distance(0, enough);
      EXPECT_LE(distance, std::max(gap, enough) + 1e-12);
      EXPECT_GE(distance, std::min(gap, enough) - 1e-12);
      if (gap < enough) {
        EXPECT_NEAR(distance, gap, 1e-12);
      }
      const double bound = boxes->pair_bound(0, enough);
      EXPECT_LE(bound, std::min(gap, enough) + 1e-12);
      EXPECT_GE(bound, 0.0);
    }
  }
}

TEST_P(EveryChecker, NamesThePair) {
  Scene scene = scene_of(test::gantry(Box{{0.1, 0.1, 0.1}}));
  add_object(scene, "left wall", Box{{0.1, 1, 1}}, Eigen::Vector3d(-0.5, 0, 0));
  add_object(scene, "right wall", Box{{0.1, 1, 1}}, Eigen::Vector3d(0.5, 0, 0));
  const auto walls = checker(scene);
  const NamedPair closest = find_clearance(*walls, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(closest.a, "probe");
  EXPECT_EQ(closest.b, "right wall");
  EXPECT_NEAR(closest.distance, 0.3, 1e-12);
  const auto touching = find_collisions(*walls, Eigen::Vector3d(-0.45, 0, 0));
  ASSERT_EQ(touching.size(), 1U);
  EXPECT_EQ(touching[0].a, "probe");
  EXPECT_EQ(touching[0].b, "left wall");
  EXPECT_EQ(touching[0].distance, 0.0);
}

TEST_P(EveryChecker, MeasuresFromTheWallsOfARoom) {
  Scene room = probe_and(Box{{0.1, 0.1, 0.1}}, Box{{1, 1, 1}});
  room.objects.front().solid = false;
  const auto boxes = checker(room);
  EXPECT_FALSE(boxes->first_collision(Eigen::Vector3d(0, 0, 0))) << "wholly inside";
  EXPECT_NEAR(find_clearance(*boxes, Eigen::Vector3d(0, 0, 0)).distance, 0.45, 1e-12);
}

TEST_P(EveryChecker, IsInfinitelyClearWithoutPairs) {
  const auto alone = checker(scene_of(test::gantry(Box{})));
  EXPECT_EQ(find_clearance(*alone, Eigen::Vector3d::Zero()).distance,
            std::numeric_limits<double>::infinity());
  EXPECT_FALSE(alone->first_collision(Eigen::Vector3d::Zero()));
}

TEST_P(EveryChecker, RefusesConfigurationsThatAreNone) {
  const auto boxes = checker(probe_and(Box{}, Box{}));
  EXPECT_THROW(boxes->place(Eigen::Vector2d(0, 0)), std::invalid_argument);
  EXPECT_THROW(boxes->place(Eigen::Vector3d(0, std::nan(""), 0)), std::invalid_argument);
  EXPECT_THROW(boxes->place(Eigen::Vector3d(0, std::numeric_limits<double>::infinity(), 0)),
               std::invalid_argument);
}

TEST_P(EveryChecker, CountsWhatItWasAsked) {
  const auto balls = checker(probe_and(Sphere{0.1}, Sphere{0.2}));
  static_cast<void>(balls->first_collision(Eigen::Vector3d(0.299, 0, 0)));
  static_cast<void>(find_clearance(*balls, Eigen::Vector3d(0.31, 0, 0)));
  EXPECT_EQ(balls->counts().configurations, 2U);
  EXPECT_EQ(balls->counts().pair_collisions, 1U);
  EXPECT_EQ(balls->counts().pair_distances, 1U);
  EXPECT_GE(balls->counts().exact_tests, 1U);
  EXPECT_EQ(balls->clone()->counts().configurations, 0U);
  balls->reset_counts();
  EXPECT_EQ(balls->counts().configurations, 0U);
}

TEST_P(EveryChecker, HasIndependentClones) {
  const auto first = checker(probe_and(Box{{0.2, 0.2, 0.2}}, Box{{0.4, 0.4, 0.4}}));
  const auto second = first->clone();
  first->place(Eigen::Vector3d(0.35, 0, 0));
  second->place(Eigen::Vector3d(0.25, 0, 0));
  EXPECT_FALSE(first->pair_collides(0));
  EXPECT_TRUE(second->pair_collides(0));
}

INSTANTIATE_TEST_SUITE_P(Checkers, EveryChecker,
                         testing::Values(Kind{"Fcl", make<FclChecker>},
                                         Kind{"Bounded", make<ExactCollisionChecker>}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace handway::geometric
