/// Primitives of any size, anywhere: the answers of FCL on their triangles.
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/scale.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kTolerance = 1e-6;  // m
constexpr double kEnough = 1.0;      // m
constexpr int kScenes = 20;
constexpr int kConfigurations = 12;

class RandomShapes {
 public:
  explicit RandomShapes(unsigned seed) : engine_(seed) {}

  // Returns a length between `least` and `most` (m), as often small as large.
  double length(double least, double most) {
    return least * std::pow(most / least, between(0.0, 1.0));
  }

  Shape shape(double least, double most) {
    const auto side = [&] { return length(least, most); };
    switch (std::uniform_int_distribution<int>(0, 3)(engine_)) {
      case 0:
        return Box{{side(), side(), side()}};
      case 1:
        return Sphere{side()};
      case 2:
        return Cylinder{side(), side()};
      default:
        return Cone{side(), side()};
    }
  }

  // Turned anyhow, a point of its surface near the origin.
  Pose pose(const Shape& shape) {
    const TriangleMesh mesh = *tessellate(shape);
    const auto& [a, b, c] = mesh.triangles[std::uniform_int_distribution<std::size_t>(
        0, mesh.triangles.size() - 1)(engine_)];
    const double u = between(0.0, 0.5);
    const double v = between(0.0, 0.5);
    const Eigen::Vector3d on_surface =
        (1.0 - u - v) * mesh.vertices[a] + u * mesh.vertices[b] + v * mesh.vertices[c];
    const Pose turned =
        pose_from_rpy(Eigen::Vector3d::Zero(), between(-3, 3), between(-1.5, 1.5), between(-3, 3));
    return Eigen::Translation3d(point(0.5)) * turned * Eigen::Translation3d(-on_surface);
  }

  Eigen::Vector3d point(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  std::mt19937_64 engine_;
};

void expect_same(FclChecker& exact, ExactCollisionChecker& bounded, const Configuration& q) {
  exact.place(q);
  bounded.place(q);
  bool any = false;
  for (int pair = 0; pair < static_cast<int>(exact.world().pairs().size()); ++pair) {
    const double distance = exact.pair_distance(pair, kEnough);
    SCOPED_TRACE(testing::Message()
                 << "pair " << pair << " at " << q.transpose() << ", " << distance << " m apart");
    ASSERT_NEAR(std::min(bounded.pair_distance(pair, kEnough), kEnough),
                std::min(distance, kEnough), kTolerance);
    ASSERT_LE(bounded.pair_bound(pair, kEnough), distance + kTolerance);
    const bool collides = exact.pair_collides(pair);
    any = any || collides;
    ASSERT_EQ(bounded.pair_collides(pair), collides);
    for (const double tolerance : {1e-4, 1e-3, 1e-2, 1e-1}) {
      if (std::abs(distance - tolerance) > kTolerance) {
        ASSERT_EQ(bounded.pair_proximity(pair, tolerance) == Proximity::kClear,
                  distance > tolerance)
            << tolerance;
      }
    }
  }
  ASSERT_EQ(bounded.first_collision(q).has_value(), any);
}

class Primitives : public testing::TestWithParam<double> {};

TEST_P(Primitives, HaveTheAnswersOfFcl) {
  const Eigen::Vector3d offset = GetParam() * Eigen::Vector3d(1.0, -0.7, 0.3);
  RandomShapes random(17);
  for (int scene_number = 0; scene_number < test::scaled(kScenes); ++scene_number) {
    const bool is_extreme = scene_number % 2 == 1;
    Scene scene = test::scene_of(test::gantry(random.shape(0.01, 0.3)));
    scene.robots.front().X_WB = Eigen::Translation3d(offset) * scene.robots.front().X_WB;
    for (int i = 0; i < 4; ++i) {
      const Shape shape = is_extreme ? random.shape(1e-6, 1e3) : random.shape(0.01, 2.0);
      test::add_object(scene, "thing " + std::to_string(i), shape,
                       Eigen::Translation3d(offset) * random.pose(shape));
      scene.objects.back().solid = i != 3;
    }
    const auto world = std::make_shared<const CollisionWorld>(scene);
    FclChecker exact(world);
    ExactCollisionChecker bounded(world);
    for (int i = 0; i < kConfigurations; ++i) {
      SCOPED_TRACE(testing::Message() << "scene " << scene_number);
      ASSERT_NO_FATAL_FAILURE(expect_same(exact, bounded, random.point(0.9)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Offsets, Primitives, testing::Values(0.0, 150.0, 5000.0));

// Parts that a checker has built by then must not show: neither in the pair that is found nor in
// bounds.
TEST(PrimitivesOnDemand, AnswerTheSameWhateverWasAskedBefore) {
  RandomShapes random(23);
  Scene scene = test::scene_of(test::gantry(random.shape(0.05, 0.2)));
  for (int i = 0; i < 12; ++i) {
    const Shape shape = random.shape(0.02, 0.5);
    test::add_object(scene, "thing " + std::to_string(i), shape, random.pose(shape));
  }
  const auto world = std::make_shared<const CollisionWorld>(scene);
  std::vector<Configuration> configurations;
  for (int i = 0; i < 100; ++i) {
    configurations.emplace_back(random.point(0.9));
  }
  const auto answers_in_order = [&](ExactCollisionChecker& checker, const auto& order) {
    std::vector<std::vector<double>> answers(configurations.size());
    for (const std::size_t i : order) {
      checker.place(configurations[i]);
      for (int pair = 0; pair < static_cast<int>(world->pairs().size()); ++pair) {
        answers[i].push_back(checker.pair_bound(pair, 0.2));
        answers[i].push_back(checker.pair_distance_range(pair, 0.2, 0.5).lower);
      }
      answers[i].push_back(checker.first_collision(configurations[i], 0).value_or(-1));
    }
    return answers;
  };
  std::vector<std::size_t> order(configurations.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::vector<double>> forwards;
  {
    ExactCollisionChecker checker(world);
    forwards = answers_in_order(checker, order);
  }
  std::ranges::reverse(order);
  ExactCollisionChecker checker(world);
  EXPECT_EQ(answers_in_order(checker, order), forwards);
}

}  // namespace
}  // namespace handway::geometric
