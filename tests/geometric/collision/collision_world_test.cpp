#include "handway/geometric/collision/collision_world.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

namespace handway::geometric {
namespace {

using test::add_object;
using test::scene_of;
using testing::HasSubstr;
using testing::IsEmpty;

std::set<std::string> pair_names(const CollisionWorld& world) {
  std::set<std::string> names;
  for (const BodyPair& pair : world.pairs()) {
    names.insert(world.body(pair.a).name + "+" + world.body(pair.b).name);
  }
  return names;
}

void carry(Scene& scene, const std::string& object, const std::string& link,
           const std::vector<std::string>& touching) {
  for (SceneObject& candidate : scene.objects) {
    if (candidate.name == object) {
      candidate.attachment = Attachment{scene.robots.front().name, link, touching};
    }
  }
}

TEST(CollisionWorld, NeedsARobot) {
  try {
    const CollisionWorld world{Scene{}};
    FAIL() << "a scene without a robot was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("robot"));
  }
}

TEST(CollisionWorld, ListsWhatMovesAgainstEachOther) {
  Scene scene = scene_of(test::gantry(Box{}));
  add_object(scene, "table", Box{}, Eigen::Vector3d(0, 0, -2));
  const CollisionWorld world(scene);
  EXPECT_EQ(pair_names(world), std::set<std::string>{"probe+table"});
  EXPECT_FALSE(world.is_self_pair(world.pairs().front()));
}

TEST(CollisionWorld, LeavesOutAllowedPairs) {
  RobotDescription robot = test::planar_hand_arm();
  const std::set<std::string> before = pair_names(CollisionWorld(scene_of(robot)));
  EXPECT_FALSE(before.contains("upper+lower"));
  ASSERT_TRUE(before.contains("left+right") || before.contains("right+left"));
  robot.allowed_collisions.allow("right", "left", AllowedReason::kUser);
  const std::set<std::string> after = pair_names(CollisionWorld(scene_of(robot)));
  EXPECT_EQ(after.size() + 1, before.size());
  EXPECT_FALSE(after.contains("left+right") || after.contains("right+left"));
}

TEST(CollisionWorld, LeavesOutPairsThatNothingMoves) {
  RobotDescription robot = test::planar_hand_arm();
  robot.allowed_collisions = {};
  Scene scene = scene_of(robot);
  scene.robots.front().X_WB.translation().x() = 5.0;
  const std::set<std::string> pairs = pair_names(CollisionWorld(scene));
  EXPECT_TRUE(pairs.contains("upper+lower"));
  EXPECT_FALSE(pairs.contains("lower+palm") || pairs.contains("palm+lower"));
}

TEST(CollisionWorld, ChecksACarriedObjectAgainstAllButItsCarrier) {
  Scene scene = scene_of(test::planar_hand_arm());
  add_object(scene, "can", Cylinder{0.02, 0.1}, Eigen::Vector3d(0.1, 0, 0));
  add_object(scene, "table", Box{}, Eigen::Vector3d(0, 0, -2));
  carry(scene, "can", "palm", {"left"});
  const std::set<std::string> pairs = pair_names(CollisionWorld(scene));
  EXPECT_TRUE(pairs.contains("right+can"));
  EXPECT_TRUE(pairs.contains("can+table"));
  EXPECT_TRUE(pairs.contains("upper+can"));
  EXPECT_FALSE(pairs.contains("palm+can")) << "the carrier";
  EXPECT_FALSE(pairs.contains("lower+can")) << "fixed to the carrier";
  EXPECT_FALSE(pairs.contains("left+can")) << "may touch";
}

TEST(CollisionWorld, MovesACarriedObjectWithItsLink) {
  Scene scene = scene_of(test::gantry(Box{{0.02, 0.02, 0.02}}));
  add_object(scene, "can", Sphere{0.05}, Eigen::Vector3d(0.2, 0, 0));
  add_object(scene, "wall", Box{{0.1, 1, 1}}, Eigen::Vector3d(0.5, 0, 0));
  carry(scene, "can", "probe", {});
  FclChecker checker(std::make_shared<const CollisionWorld>(scene));
  EXPECT_THAT(find_collisions(checker, Eigen::Vector3d(0.15, 0, 0)), IsEmpty());
  const auto touching = find_collisions(checker, Eigen::Vector3d(0.22, 0, 0));
  ASSERT_EQ(touching.size(), 1U);
  EXPECT_EQ(touching[0].a, "can");
  EXPECT_EQ(touching[0].b, "wall");
}

TEST(CollisionWorld, RefusesAnAttachmentToNothing) {
  Scene scene = scene_of(test::gantry(Box{}));
  add_object(scene, "can", Sphere{}, Eigen::Vector3d(0.2, 0, 0));
  carry(scene, "can", "gripper", {});
  try {
    const CollisionWorld world(scene);
    FAIL() << "a link that is not there was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("can"));
    EXPECT_THAT(error.what(), HasSubstr("gantry/gripper"));
  }
}

TEST(CollisionWorld, LetsOtherRobotsStandStill) {
  Scene scene = scene_of(test::gantry(Box{{0.1, 0.1, 0.1}}));
  RobotInstance other = scene_of(test::gantry(Box{{0.1, 0.1, 0.1}})).robots.front();
  other.name = "other";
  other.X_WB.translation().y() = 0.5;
  other.configuration = Eigen::Vector3d(0.25, 0, 0);
  scene.robots.push_back(other);
  FclChecker checker(std::make_shared<const CollisionWorld>(scene));
  EXPECT_EQ(pair_names(checker.world()), std::set<std::string>{"probe+other/probe"});
  EXPECT_NEAR(find_clearance(checker, Eigen::Vector3d(0.25, 0, 0)).distance, 0.4, 1e-12);
  EXPECT_EQ(find_collisions(checker, Eigen::Vector3d(0.25, 0.45, 0)).size(), 1U);
}

TEST(CollisionWorld, StandsWhereItsBaseStands) {
  Scene scene = scene_of(test::gantry(Sphere{0.1}));
  scene.robots.front().X_WB =
      pose_from_rpy({0.3, -0.2, 0.1}, 0.0, 0.0, M_PI / 2);  // its x is the world's y
  const CollisionWorld world(scene);
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(Eigen::Vector3d(0.5, 0, 0), X_BL, X_WBody);
  EXPECT_TRUE(X_WBody[0].translation().isApprox(Eigen::Vector3d(0.3, 0.3, 0.1), 1e-12));
}

/// Three boxes, of which the probe carries the last and may touch the second with it.
class ChangedWorld : public testing::Test {
 protected:
  ChangedWorld() {
    for (const char* name : {"table", "shelf", "tool"}) {
      add_object(scene_, name, Box{}, Eigen::Vector3d(0, 0, -2));
    }
    carry(scene_, "tool", "probe", {"shelf"});
  }

  // Expects equal bodies and pairs in the same order, with the meshes of `before` where it has
  // them.
  static void expect_same(const CollisionWorld& changed, const Scene& scene,
                          const CollisionWorld& before) {
    const CollisionWorld anew(scene);
    ASSERT_EQ(changed.bodies().size(), anew.bodies().size());
    for (std::size_t i = 0; i < anew.bodies().size(); ++i) {
      const CollisionBody& body = changed.bodies()[i];
      EXPECT_EQ(body.name, anew.bodies()[i].name);
      EXPECT_TRUE(body.X_FB.isApprox(anew.bodies()[i].X_FB));
      for (const CollisionBody& old : before.bodies()) {
        EXPECT_TRUE(old.name != body.name || old.mesh == body.mesh) << body.name;
      }
    }
    ASSERT_EQ(changed.pairs().size(), anew.pairs().size());
    for (std::size_t p = 0; p < anew.pairs().size(); ++p) {
      EXPECT_EQ(changed.pairs()[p].a, anew.pairs()[p].a) << p;
      EXPECT_EQ(changed.pairs()[p].b, anew.pairs()[p].b) << p;
    }
  }

  Scene scene_ = scene_of(test::gantry(Box{}));
};

TEST_F(ChangedWorld, IsTheWorldOfTheSceneWithAnObjectMoved) {
  const CollisionWorld world(scene_);
  scene_.objects[0].X_PO.translation().x() = 0.5;
  expect_same(world.with_object_at("table", scene_.objects[0].X_PO), scene_, world);
}

TEST_F(ChangedWorld, IsTheWorldOfTheSceneWithAnObjectTakenAway) {
  const CollisionWorld world(scene_);
  scene_.objects.erase(scene_.objects.begin());
  expect_same(world.without_object("table"), scene_, world);
}

TEST_F(ChangedWorld, IsTheWorldOfTheSceneWithAnObjectMore) {
  const SceneObject shelf = scene_.objects[1];
  scene_.objects.erase(scene_.objects.begin() + 1);
  const CollisionWorld world(scene_);
  scene_.objects.push_back(shelf);  // the tool may touch it
  expect_same(world.with_object(shelf), scene_, world);
}

TEST_F(ChangedWorld, NamesAnObjectThatItCannotChange) {
  const CollisionWorld world(scene_);
  for (const char* name : {"vase", "tool"}) {  // unknown; carried
    try {
      const CollisionWorld changed = world.with_object_at(name, Pose::Identity());
      FAIL() << name << " was moved";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
    EXPECT_THROW((void)world.without_object(name), InputError);
  }
  EXPECT_THROW((void)world.with_object(scene_.objects[0]), InputError) << "a name that is taken";
  SceneObject carried = scene_.objects[2];
  carried.name = "another tool";
  EXPECT_THROW((void)world.with_object(carried), InputError);
}

TEST_F(ChangedWorld, ListsThePairsOfAnObject) {
  const CollisionWorld world(scene_);
  std::set<std::string> names;
  for (const int pair : world.pairs_with("table")) {
    names.insert(world.body(world.pairs()[static_cast<std::size_t>(pair)].a).name);
  }
  EXPECT_EQ(names, (std::set<std::string>{"probe", "tool"}));
  EXPECT_THAT(world.pairs_with("vase"), IsEmpty());
}

}  // namespace
}  // namespace handway::geometric
