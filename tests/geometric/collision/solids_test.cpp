/// Tests that bodies inside of a solid collide with it, for every checker.
#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {

void PrintTo(CheckerKind kind, std::ostream* out) { *out << static_cast<int>(kind); }

namespace {

using test::add_object;
using test::scene_of;

Mesh in_memory(TriangleMesh mesh) {
  return {"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  return mesh;
}

// Returns a box without the two triangles of its lid.
TriangleMesh open_box(const Eigen::Vector3d& size) {
  TriangleMesh box = *tessellate(Box{size});
  std::erase_if(box.triangles, [&](const auto& t) {
    return box.vertices[t[0]].z() > 0 && box.vertices[t[1]].z() > 0 && box.vertices[t[2]].z() > 0;
  });
  return box;
}

TriangleMesh moved(const Shape& shape, const Eigen::Vector3d& p) {
  return transformed(*tessellate(shape), Pose(Eigen::Translation3d(p)));
}

class Solids : public testing::TestWithParam<CheckerKind> {
 protected:
  /// Returns whether a probe of that shape collides with an object at the origin when it is at `p`.
  static bool collides(const Shape& probe, const Shape& object,
                       const Eigen::Vector3d& p = Eigen::Vector3d::Zero(), bool solid = true) {
    Scene scene = scene_of(test::gantry(probe));
    add_object(scene, "object", object, Pose::Identity());
    scene.objects.back().solid = solid;
    const auto checker = checker_of(scene);
    const bool found = checker->first_collision(p).has_value();
    EXPECT_EQ(checker->pair_collides(0), found);
    EXPECT_EQ(checker->pair_proximity(0, 0.01) == Proximity::kCollision, found);
    EXPECT_EQ(checker->pair_proximity(0, 100.0) == Proximity::kCollision, found);
    EXPECT_EQ(checker->pair_distance(0, 100.0) == 0.0, found);
    EXPECT_EQ(checker->pair_distance_range(0, 0.01, 0.2).upper == 0.0, found);
    EXPECT_EQ(is_closer_than(*checker, p, 1e-6), found);
    EXPECT_EQ(find_collisions(*checker, p).size(), found ? 1U : 0U);
    if (found) {
      EXPECT_LE(checker->pair_bound(0, 100.0), 0.0);
      EXPECT_LE(checker->pair_bound(0, 0.001), 0.0);
      EXPECT_EQ(find_clearance(*checker, p).distance, 0.0);
    }
    return found;
  }

  static std::unique_ptr<CollisionChecker> checker_of(const Scene& scene) {
    return make_collision_checker(std::make_shared<const CollisionWorld>(scene), GetParam());
  }
};

TEST_P(Solids, CollideWithARobotThatIsInsideOfThem) {
  Scene scene = scene_of(test::solid_tx90_sah());
  add_object(scene, "room", Box{{20, 20, 20}}, Pose::Identity());
  const auto checker = checker_of(scene);
  test::RandomConfigurations random(checker->world().model(), 1);
  for (int i = 0; i < 20; ++i) {
    const Configuration q = random.next();
    ASSERT_TRUE(checker->first_collision(q));
    for (const int pair : checker->world().pairs_with("room")) {
      EXPECT_TRUE(checker->pair_collides(pair));
    }
    EXPECT_EQ(find_clearance(*checker, q).distance, 0.0);
  }
}

TEST_P(Solids, CollideWithWhatIsInsideOfALink) {
  EXPECT_TRUE(collides(Box{{0.5, 0.5, 0.5}}, Sphere{0.02}));
  EXPECT_TRUE(collides(Cylinder{0.3, 0.5}, Sphere{0.02}, {0.2, 0.1, 0.1}));
  EXPECT_FALSE(collides(Cylinder{0.3, 0.5}, Sphere{0.02}, {0.25, 0.25, 0.1})) << "in its box only";
}

TEST_P(Solids, AreAllPrimitives) {
  for (const Shape& shape : {Shape(Box{{1, 1, 1}}), Shape(Sphere{0.5}), Shape(Cylinder{0.5, 1.0}),
                             Shape(Cone{0.5, 1.0})}) {
    EXPECT_TRUE(is_closed(shape));
    EXPECT_TRUE(collides(Sphere{0.02}, shape)) << shape_name(shape);
    EXPECT_FALSE(collides(Sphere{0.02}, shape, {0.48, 0.48, 0.6})) << shape_name(shape);
  }
}

TEST_P(Solids, AreClosedMeshesWoundEitherWay) {
  const TriangleMesh box = *tessellate(Box{{1, 1, 1}});
  TriangleMesh mixed = box;
  std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
  TriangleMesh twice = box;
  append(twice, inside_out(box));
  for (const TriangleMesh& mesh : {box, inside_out(box), mixed, twice}) {
    EXPECT_TRUE(is_closed(Shape(in_memory(mesh))));
    EXPECT_TRUE(collides(Sphere{0.02}, in_memory(mesh), {0.2, 0.1, 0.3}));
    EXPECT_FALSE(collides(Sphere{0.02}, in_memory(mesh), {0.2, 0.1, 0.6}));
  }
}

TEST_P(Solids, AreNotOpenMeshes) {
  const Mesh open = in_memory(open_box({1, 1, 1}));
  EXPECT_FALSE(is_closed(Shape(open)));
  EXPECT_FALSE(collides(Sphere{0.02}, open));
  EXPECT_TRUE(collides(Sphere{0.02}, open, {0.49, 0, 0})) << "its wall";
  TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}};
  EXPECT_FALSE(is_closed(Shape(in_memory(sheet)))) << "drawn from both sides, but a sheet";
}

TEST_P(Solids, AreNotRooms) {
  EXPECT_FALSE(collides(Sphere{0.02}, Box{{1, 1, 1}}, {0, 0, 0}, false));
  EXPECT_TRUE(collides(Sphere{0.02}, Box{{1, 1, 1}}, {0.5, 0, 0}, false)) << "its wall";
  EXPECT_TRUE(collides(Box{{1, 1, 1}}, Sphere{0.02}, {0.1, 0, 0}, false)) << "in a solid link";
}

TEST_P(Solids, LeaveFreeWhatTheirSurfaceGoesAround) {
  // A mug: a cylinder's wall around what can be put into it.
  TriangleMesh ring;
  constexpr std::uint32_t kAround = 24;
  const std::vector<Eigen::Vector2d> profile{{0.1, 0.0}, {0.1, 0.2}, {0.09, 0.2}, {0.09, 0.0}};
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const double angle = 2.0 * M_PI * i / kAround;
    for (const Eigen::Vector2d& corner : profile) {
      ring.vertices.emplace_back(corner.x() * std::cos(angle), corner.x() * std::sin(angle),
                                 corner.y());
    }
    const std::uint32_t next = (i + 1) % kAround;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t l = (k + 1) % 4;
      ring.triangles.push_back({4 * i + k, 4 * next + k, 4 * i + l});
      ring.triangles.push_back({4 * next + k, 4 * next + l, 4 * i + l});
    }
  }
  ASSERT_TRUE(is_closed(Shape(in_memory(ring))));
  EXPECT_FALSE(collides(Sphere{0.02}, in_memory(ring), {0, 0, 0.1}));
  EXPECT_TRUE(collides(Sphere{0.002}, in_memory(ring), {0.0945, 0, 0.1}));
}

TEST_P(Solids, AreEachPieceOfAMesh) {
  TriangleMesh two = moved(Sphere{0.1}, {0.4, 0, 0});
  append(two, moved(Sphere{0.1}, {-0.4, 0, 0}));
  append(two, inside_out(moved(Sphere{0.3}, {-0.4, 0, 0})));  // around the other one
  EXPECT_TRUE(collides(Sphere{0.02}, in_memory(two), {0.4, 0.02, 0}));
  EXPECT_TRUE(collides(Sphere{0.02}, in_memory(two), {-0.4, 0.02, 0}));
  EXPECT_TRUE(collides(Sphere{0.02}, in_memory(two), {-0.4, 0.2, 0}));
  EXPECT_FALSE(collides(Sphere{0.02}, in_memory(two), {0, 0.1, 0}));
}

TEST_P(Solids, CollideWithOnePieceOfALink) {
  TriangleMesh dumbbell = moved(Sphere{0.02}, {0.5, 0, 0});
  append(dumbbell, moved(Sphere{0.02}, {-0.5, 0, 0}));
  EXPECT_TRUE(collides(in_memory(dumbbell), Box{{0.2, 0.2, 0.2}}, {0.5, 0, 0}));
  EXPECT_TRUE(collides(in_memory(dumbbell), Box{{0.2, 0.2, 0.2}}, {-0.5, 0.05, 0}));
  EXPECT_FALSE(collides(in_memory(dumbbell), Box{{0.2, 0.2, 0.2}}, {0, 0, 0}));
}

TEST_P(Solids, CollideWithLinksAndAttachedObjects) {
  // The probe's box hides what another slide of the robot carries.
  RobotDescription robot = test::gantry(Box{{0.4, 0.4, 0.4}});
  robot.links.push_back({"pin", {}, {{Sphere{0.02}, Pose::Identity(), {}}}});
  Joint joint = robot.joints.front();
  joint.name = "slide";
  joint.parent = "frame";
  joint.child = "pin";
  robot.joints.push_back(joint);
  Scene scene = scene_of(robot);
  add_object(scene, "ball", Sphere{0.02}, Eigen::Vector3d(0, 0.5, 0));
  scene.objects.back().attachment = Attachment{scene.robots.front().name, "pin", {}};
  const auto checker = checker_of(scene);
  const auto collisions = [&](const Eigen::Vector4d& q) {
    std::vector<std::string> names;
    for (const NamedPair& pair : find_collisions(*checker, q)) {
      names.push_back(pair.a + " " + pair.b);
    }
    return names;
  };
  EXPECT_EQ(collisions({0, 0, 0, 0.1}), std::vector<std::string>{"probe pin"});
  EXPECT_EQ(collisions({0, 0.5, 0, 0.1}), std::vector<std::string>{"probe ball"});
  EXPECT_EQ(collisions({0, -0.5, 0, 0.1}), std::vector<std::string>{});
}

TEST_P(Solids, RefuseMotionsInsideOfThem) {
  Scene scene = scene_of(test::gantry(Sphere{0.02}));
  add_object(scene, "room", Box{{20, 20, 20}}, Pose::Identity());
  const auto checker = checker_of(scene);
  ContinuousCollisionChecker edges(*checker, std::make_shared<const MotionBound>(checker->world()),
                                   5e-5);
  EXPECT_FALSE(edges.check(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 0.2, 0)).free);
  EXPECT_FALSE(edges.check(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e-6, 0, 0)).free);
}

TEST_P(Solids, TellWhereTheyAreEntered) {
  Scene scene = scene_of(test::gantry(Sphere{0.02}));
  add_object(scene, "block", Box{{2, 2, 0.2}}, Pose::Identity());
  const auto checker = checker_of(scene);
  const std::vector<Contact> contacts = find_contacts(*checker, Eigen::Vector3d(0, 0, 0.05));
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].depth, 0.07, 1e-3);
  EXPECT_GT(contacts[0].direction.z(), 0.99);
  EXPECT_LT((contacts[0].p_W - Eigen::Vector3d(0, 0, 0.05)).norm(), 0.021);
}

INSTANTIATE_TEST_SUITE_P(AllCheckers, Solids,
                         testing::Values(CheckerKind::kFast, CheckerKind::kFcl,
                                         CheckerKind::kFclBroadphase));

}  // namespace
}  // namespace handway::geometric
