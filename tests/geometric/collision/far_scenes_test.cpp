/// Scenes that are far from the origin or large: the answers of the scene at the origin.
#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/resource_use.h"
#include "handway_test/scale.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;
using test::RandomConfigurations;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kTolerance = 1e-6;  // m

// The hand-arm robot in a hall, with things around it small and large.
Scene hall() {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  add_object(scene, "floor", Box{{2000, 10000, 0.1}}, Eigen::Vector3d(300, -2000, -0.1));
  add_object(scene, "wall", Box{{0.2, 1000, 20}}, pose_from_rpy({1.1, 200, 5}, 0, 0, 0.1));
  add_object(scene, "cable", Cylinder{0.01, 1000}, pose_from_rpy({0.2, 300, 1.4}, 1.57, 0, 0));
  add_object(scene, "shelf", Box{{0.4, 0.8, 0.01}}, Eigen::Vector3d(0.7, 0, 0.6));
  add_object(scene, "can", test::as_mesh(Cylinder{0.035, 0.12}), Eigen::Vector3d(0.65, 0.1, 0.67));
  add_object(scene, "cone", Cone{0.1, 0.3}, pose_from_rpy({-0.4, -0.4, 0.5}, 0.4, 0.3, 0.2));
  add_object(scene, "carried", test::as_mesh(Cylinder{0.03, 0.12}), Eigen::Vector3d(0.06, 0, 0.15));
  scene.objects.back().attachment = Attachment{"tx90_sah", "Palm", {"Thumb-Dist", "Mid-Dist"}};
  return scene;
}

Scene with_poses_at(Scene scene, const Eigen::Vector3d& offset) {
  scene.robots.front().X_WB = Eigen::Translation3d(offset) * scene.robots.front().X_WB;
  for (SceneObject& object : scene.objects) {
    if (!object.attachment) {
      object.X_PO = Eigen::Translation3d(offset) * object.X_PO;
    }
  }
  return scene;
}

// Moves the frame far from the triangles, which stay in the same place.
void move_vertices(Shape& shape, Pose& X, const Eigen::Vector3d& offset) {
  const Pose by(Eigen::Translation3d{offset});
  shape = Mesh{"", Eigen::Vector3d::Ones(),
               std::make_shared<const TriangleMesh>(transformed(*tessellate(shape), by))};
  X = X * by.inverse();
}

// Each link's mesh is far from the link's frame, which is so far off the other way that the link
// is where it was; objects likewise.
Scene with_vertices_at(const Eigen::Vector3d& offset) {
  Scene scene = hall();
  RobotDescription robot = scene.robots.front().model->description();
  for (Link& link : robot.links) {
    for (LinkGeometry& geometry : link.collision) {
      move_vertices(geometry.shape, geometry.X_LG, offset);
    }
  }
  scene.robots.front().model = std::make_shared<const RobotModel>(robot);
  for (SceneObject& object : scene.objects) {
    move_vertices(object.shape, object.X_PO, offset);
  }
  return scene;
}

class FarScene : public testing::TestWithParam<double> {
 protected:
  // Compares every pair with the distances that FCL finds at the origin.
  void expect_same_answers(const Scene& far) {
    const auto near_world = std::make_shared<const CollisionWorld>(hall());
    const auto far_world = std::make_shared<const CollisionWorld>(far);
    FclChecker exact(near_world);
    ExactCollisionChecker bounded(far_world);
    FclChecker exact_far(far_world);
    RandomConfigurations random(near_world->model(), 3);
    constexpr double kEnough = 0.05;
    int touching = 0;
    int close = 0;
    for (int i = 0; i < test::scaled(25); ++i) {
      const Configuration q = random.next();
      exact.place(q);
      exact_far.place(q);
      bounded.place(q);
      for (int pair = 0; pair < static_cast<int>(near_world->pairs().size()); ++pair) {
        const double distance = exact.pair_distance(pair, kEnough);
        const std::string name = named_pair(*near_world, pair, distance).a + " with " +
                                 named_pair(*near_world, pair, distance).b;
        touching += distance <= 0.0 ? 1 : 0;
        close += distance > 0.0 && distance < kEnough ? 1 : 0;
        for (CollisionChecker* checker : {static_cast<CollisionChecker*>(&bounded),
                                          static_cast<CollisionChecker*>(&exact_far)}) {
          const double found = checker->pair_distance(pair, kEnough);
          ASSERT_NEAR(std::min(found, kEnough), std::min(distance, kEnough), kTolerance) << name;
          ASSERT_LE(checker->pair_bound(pair, kEnough), distance + kTolerance) << name;
          ASSERT_LE(std::min(checker->pair_quick_bound(pair), kEnough), distance + kTolerance)
              << name;
          if (distance > kTolerance) {
            ASSERT_FALSE(checker->pair_collides(pair)) << name;
          } else if (distance <= 0.0) {
            ASSERT_TRUE(checker->pair_collides(pair) || found < kTolerance) << name;
          }
        }
      }
    }
    EXPECT_GT(touching, test::scaled(10));
    EXPECT_GT(close, test::scaled(10));
  }

  // Edges that are free here and there, by their clearance.
  void expect_same_certificates(const Scene& far) {
    Edges near_edges(hall());
    Edges far_edges(far);
    RandomConfigurations random(near_edges.world->model(), 4);
    int compared = 0;
    for (int i = 0; i < 2000 && compared < 8; ++i) {
      const Configuration from = random.next();
      const Configuration to = from + 0.02 * (random.next() - from);
      if (near_edges.checker.first_collision(from) || near_edges.checker.first_collision(to) ||
          !near_edges.edges.check(from, to).free) {
        continue;
      }
      ++compared;
      const double clearance =
          near_edges.edges.clearance(std::array{from, to}, 0.2, kTolerance / 2).distance;
      const EdgeResult there = far_edges.edges.check(from, to);
      ASSERT_TRUE(there.free || clearance < 2e-4) << clearance;
      if (there.free) {
        EXPECT_NEAR(far_edges.edges.clearance(std::array{from, to}, 0.2, kTolerance / 2).distance,
                    clearance, kTolerance);
      }
    }
    EXPECT_GE(compared, 8);
  }

  struct Edges {
    explicit Edges(const Scene& scene)
        : world(std::make_shared<const CollisionWorld>(scene)),
          checker(world),
          edges(checker, std::make_shared<const MotionBound>(*world), 1e-4) {}

    std::shared_ptr<const CollisionWorld> world;
    ExactCollisionChecker checker;
    ContinuousCollisionChecker edges;
  };

  Eigen::Vector3d offset_ = GetParam() * Eigen::Vector3d(1.0, -0.7, 0.3);
};

TEST_P(FarScene, HasTheSameAnswersWithItsPosesThere) {
  expect_same_answers(with_poses_at(hall(), offset_));
  expect_same_certificates(with_poses_at(hall(), offset_));
}

TEST_P(FarScene, HasTheSameAnswersWithItsVerticesThere) {
  expect_same_answers(with_vertices_at(offset_));
  expect_same_certificates(with_vertices_at(offset_));
}

INSTANTIATE_TEST_SUITE_P(Offsets, FarScene, testing::Values(0.0, 150.0, 5e3, 1e5));

TEST(FarPoints, AreRefusedBeyondTheRange) {
  Scene scene = hall();
  scene.objects[3].X_PO.translation().x() = 1.1e6;
  EXPECT_THAT([&] { const CollisionWorld world(scene); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("shelf"), HasSubstr("1000 km"))));
  scene = hall();
  scene.robots.front().X_WB.translation().y() = -1.1e6;
  EXPECT_THAT([&] { const CollisionWorld world(scene); },
              ThrowsMessage<InputError>(HasSubstr("robot tx90_sah")));
  const CollisionWorld world(hall());
  EXPECT_THROW(
      static_cast<void>(world.with_object_at("shelf", Pose(Eigen::Translation3d(0, 0, 1.1e6)))),
      InputError);
  SceneObject wide;
  wide.name = "wide";
  wide.shape = Box{{3e6, 1, 1}};
  EXPECT_THROW(static_cast<void>(world.with_object(wide)), InputError);
}

TEST(LargeObjects, TakeNoMoreMemoryThanSmallOnes) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  static_cast<void>(ExactCollisionChecker(std::make_shared<const CollisionWorld>(scene)));
  const std::size_t before = test::peak_memory();
  for (const double length : {1e3, 1e4, 1e6}) {
    for (const double width : {1e-3, 0.1, 10.0, 1e3}) {
      add_object(scene, "rod " + std::to_string(length) + " " + std::to_string(width),
                 Box{{length, width, width}}, Eigen::Vector3d(0, 0, -2e3));
    }
  }
  const ExactCollisionChecker checker(std::make_shared<const CollisionWorld>(scene));
  EXPECT_LT(test::peak_memory() - before, std::size_t{400} << 20);
}

}  // namespace
}  // namespace handway::geometric
