/// Meshes of so many triangles that what checkers make of them grows where queries come.
#include "checker_agreement.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

// Returns a mesh of some 115,000 triangles: a ring that bulges, around the z axis.
Mesh ring() {
  constexpr std::uint32_t kAround = 240;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double u = 2.0 * std::numbers::pi * i / kAround;
      const double v = 2.0 * std::numbers::pi * k / kAround;
      const double thick = 0.12 + 0.02 * std::sin(9.0 * u) * std::cos(7.0 * v);
      const double from_axis = 0.4 + thick * std::cos(v);
      mesh.vertices.emplace_back(from_axis * std::cos(u), from_axis * std::sin(u),
                                 thick * std::sin(v));
      const std::uint32_t next_i = (i + 1) % kAround;
      const std::uint32_t next_k = (k + 1) % kAround;
      mesh.triangles.push_back({i * kAround + k, next_i * kAround + k, next_i * kAround + next_k});
      mesh.triangles.push_back({i * kAround + k, next_i * kAround + next_k, i * kAround + next_k});
    }
  }
  return {"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

// A ring and a probe that is larger or smaller than it: either gives the spheres.
Scene ring_and(const Shape& probe) {
  Scene scene = test::scene_of(test::gantry(probe));
  test::add_object(scene, "ring", ring(), pose_from_rpy({0.1, 0.0, 0.05}, 0.2, 0.3, 0.0));
  return scene;
}

std::vector<Configuration> anywhere(int count) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(-0.8, 0.8);
  std::vector<Configuration> configurations;
  for (int i = 0; i < count; ++i) {
    configurations.emplace_back(Eigen::Vector3d(uniform(engine), uniform(engine), uniform(engine)));
  }
  return configurations;
}

class LargeMeshes : public testing::TestWithParam<Shape> {};

TEST_P(LargeMeshes, HaveTheAnswersOfFcl) {
  test::CheckerAgreement checkers(ring_and(GetParam()));
  for (const Configuration& q : anywhere(60)) {
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.1));
  }
  EXPECT_GT(checkers.frees(), 0);
}

TEST_P(LargeMeshes, AnswerTheSameWhateverWasAskedBefore) {
  const auto world = std::make_shared<const CollisionWorld>(ring_and(GetParam()));
  const std::vector<Configuration> configurations = anywhere(100);
  const auto answers_in_order = [&](const std::vector<std::size_t>& order) {
    ExactCollisionChecker checker(world);
    std::vector<std::vector<double>> answers(configurations.size());
    for (const std::size_t i : order) {
      checker.place(configurations[i]);
      answers[i] = {checker.pair_bound(0, 0.2), checker.pair_distance_range(0, 0.2, 0.5).lower,
                    checker.pair_distance_range(0, 0.2, 0.5).upper,
                    checker.first_collision(configurations[i]) ? 1.0 : 0.0};
    }
    return answers;
  };
  std::vector<std::size_t> order(configurations.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto forwards = answers_in_order(order);
  std::ranges::reverse(order);
  EXPECT_EQ(answers_in_order(order), forwards);
}

INSTANTIATE_TEST_SUITE_P(Probes, LargeMeshes,
                         testing::Values(Shape(Box{{0.05, 0.02, 0.1}}), Shape(Cylinder{0.3, 0.3}),
                                         Shape(Box{{2.0, 2.0, 0.1}}), Shape(ring())));

}  // namespace
}  // namespace handway::geometric
