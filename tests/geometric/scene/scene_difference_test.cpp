#include "handway/geometric/scene/scene_difference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using Kind = ObjectChange::Kind;

SceneObject box(const std::string& name, double x) {
  SceneObject object;
  object.name = name;
  object.shape = Box{Eigen::Vector3d::Constant(0.1)};
  object.X_PO.translation().x() = x;
  return object;
}

Scene scene_of(std::vector<SceneObject> objects) {
  Scene scene;
  scene.objects = std::move(objects);
  return scene;
}

std::vector<std::pair<Kind, std::string>> kinds(const SceneDifference& difference) {
  std::vector<std::pair<Kind, std::string>> kinds;
  for (const ObjectChange& change : difference.changes) {
    kinds.emplace_back(change.kind, change.object.name);
  }
  return kinds;
}

TEST(SceneDifference, IsEmptyForWhatCollisionsDoNotSee) {
  const Scene before = scene_of({box("a", 1.0)});
  Scene after = before;
  after.objects.front().color = {1.0F, 0.0F, 0.0F, 1.0F};
  after.display.set("a", {.hidden = true});
  EXPECT_TRUE(scene_difference(before, after)->empty());
}

TEST(SceneDifference, ListsWhatWentMovedAndCame) {
  const Scene before = scene_of({box("gone", 1.0), box("moved", 2.0), box("kept", 3.0)});
  const Scene after = scene_of({box("moved", 2.5), box("kept", 3.0), box("added", 4.0)});
  const auto difference = scene_difference(before, after);
  ASSERT_TRUE(difference);
  EXPECT_THAT(kinds(*difference), testing::ElementsAre(testing::Pair(Kind::kRemoved, "gone"),
                                                       testing::Pair(Kind::kMoved, "moved"),
                                                       testing::Pair(Kind::kAdded, "added")));
  EXPECT_TRUE(difference->keeps_order);

  Scene changed = before;
  for (const ObjectChange& change : difference->changes) {
    apply(change, changed);
  }
  EXPECT_TRUE(scene_difference(changed, after)->empty());
}

TEST(SceneDifference, ReplacesAnObjectOfAnotherShape) {
  const Scene before = scene_of({box("a", 1.0), box("b", 2.0)});
  Scene after = before;
  after.objects.front().shape = Sphere{0.2};
  const auto difference = scene_difference(before, after);
  ASSERT_TRUE(difference);
  EXPECT_THAT(kinds(*difference), testing::ElementsAre(testing::Pair(Kind::kRemoved, "a"),
                                                       testing::Pair(Kind::kAdded, "a")));
  EXPECT_FALSE(difference->keeps_order) << "it is the last now";
}

TEST(SceneDifference, IsNothingWhereACarriedObjectChanges) {
  Scene before = scene_of({box("a", 1.0)});
  Scene after = before;
  after.objects.front().attachment = Attachment{"arm", "palm", {}};
  EXPECT_FALSE(scene_difference(before, after));
  before = after;
  EXPECT_TRUE(scene_difference(before, after)->empty());
  after.objects.front().X_PO.translation().z() += 0.1;
  EXPECT_FALSE(scene_difference(before, after));
}

TEST(SceneDifference, IsNothingWhereARobotMoves) {
  Scene before;
  before.robots.resize(2);
  Scene after = before;
  EXPECT_TRUE(scene_difference(before, after)->empty());
  after.robots.back().X_WB.translation().x() = 0.1;
  EXPECT_FALSE(scene_difference(before, after));
}

}  // namespace
}  // namespace handway::geometric
