#include "features/editing/editing_test.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/planning/edits/arranging.h"

namespace handway::test {
namespace {

using Eigen::Vector3d;
using geometric::Box;

class FreePlaces : public EditingTest {
 protected:
  /// Returns whether the first robot is free as shown, at start and at goal.
  [[nodiscard]] bool robot_is_free() const {
    const auto world = std::make_shared<const geometric::CollisionWorld>(scene());
    const auto checker = geometric::make_collision_checker(world, geometric::CheckerKind::kFcl);
    for (const auto& q : {window().document().configuration(), *scene().start, *scene().goal}) {
      checker->place(q);
      for (int pair = 0; pair < static_cast<int>(world->pairs().size()); ++pair) {
        if (checker->pair_collides(pair)) {
          return false;
        }
      }
    }
    return true;
  }
  [[nodiscard]] geometric::Aabb box_of(const std::string& name) const {
    return geometric::bounds(scene(), window().document().configuration(), {name});
  }
  [[nodiscard]] bool overlap(const std::string& a, const std::string& b) const {
    const geometric::Aabb one = box_of(a), other = box_of(b);
    return (one.lower.array() < other.upper.array()).all() &&
           (other.lower.array() < one.upper.array()).all();
  }
  void add(const char* shape) const { part<QAction>(shape).trigger(); }
};

TEST_F(FreePlaces, NothingNewIsInTheRobotOrInAnotherObject) {
  ASSERT_TRUE(robot_is_free());
  for (int i = 0; i < 4; ++i) {
    add("box");
    add("sphere");
    add("cylinder");
    add("cone");
  }
  ASSERT_EQ(scene().objects.size(), 17U);
  for (std::size_t i = 0; i < scene().objects.size(); ++i) {
    for (std::size_t j = i + 1; j < scene().objects.size(); ++j) {
      EXPECT_FALSE(overlap(scene().objects[i].name, scene().objects[j].name))
          << scene().objects[i].name << " and " << scene().objects[j].name;
    }
  }
  EXPECT_TRUE(robot_is_free());
}

TEST_F(FreePlaces, ASceneFullOfRobotHasRoomBesideIt) {
  editor().select({});
  const Vector3d foot = geometric::free_foot(scene(), window().document().configuration(),
                                             {0.1, 0.1, 0.1}, Vector3d(0.0, 0.0, -0.1));
  EXPECT_GT(foot.head<2>().norm(), 0.08) << "the base is there";
  EXPECT_LT(foot.head<2>().norm(), 0.4) << "but not far around it";
}

TEST_F(FreePlaces, ACanBesideACanStandsOnTheSameTable) {
  editor().add("table", Box{{0.6, 0.6, 0.3}}, {}, {-0.8, 0.0, 0.0});
  editor().add("can", geometric::Cylinder{0.03, 0.12}, {},
               {-0.8, 0.0, 0.3 + geometric::kRestingGap});
  add("cylinder");
  EXPECT_NEAR(box_of("cylinder").lower.z(), 0.3 + geometric::kRestingGap, 1e-9);
  EXPECT_LT((box_of("cylinder").centre() - box_of("can").centre()).head<2>().norm(), 0.3);
}

TEST_F(FreePlaces, WhatIsMuchSmallerGoesOntoWhatIsSelected) {
  editor().add("table", Box{{0.6, 0.6, 0.3}}, {}, {-0.8, 0.0, 0.0});
  add("cylinder");
  EXPECT_NEAR(box_of("cylinder").lower.z(), 0.3 + geometric::kRestingGap, 1e-9);
  EXPECT_TRUE(box_of("table").lower.head<2>().isApprox(Eigen::Vector2d(-1.1, -0.3)));
  EXPECT_LT((box_of("cylinder").centre() - box_of("table").centre()).head<2>().norm(), 0.01);
}

TEST_F(FreePlaces, WhatFitsNowhereOnATableGoesToTheFloor) {
  editor().add("column", Box{{0.1, 0.1, 0.5}}, {}, {-0.8, 0.0, 0.0});
  editor().add("ball", geometric::Sphere{0.03}, {}, {-0.8, 0.0, 0.5 + geometric::kRestingGap});
  add("box");
  EXPECT_NEAR(box_of("box").lower.z(), 0.0, 1e-9);
}

TEST_F(FreePlaces, TheInsideOfASolidIsNotFreeAndThatOfARoomIs) {
  editor().add("room", Box{{3.0, 3.0, 3.0}}, {}, {5.0, 0.0, 0.0});
  const auto& q = window().document().configuration();
  const Vector3d inside(5.0, 0.0, 1.0);
  EXPECT_GT((geometric::free_foot(scene(), q, {0.1, 0.1, 0.1}, inside) - inside).norm(), 1.4);
  editor().set_solid({"room"}, false);
  EXPECT_LT((geometric::free_foot(scene(), q, {0.1, 0.1, 0.1}, inside) - inside).head<2>().norm(),
            0.01);
}

TEST_F(FreePlaces, ACopyIsBesideItsOriginalAtItsHeight) {
  select("post");
  const double height = box_of("post").lower.z();
  actions().duplicate->trigger();
  EXPECT_FALSE(overlap("post", "post 2"));
  EXPECT_NEAR(box_of("post 2").lower.z(), height, 1e-9);
  EXPECT_LT((box_of("post 2").centre() - box_of("post").centre()).norm(), 0.3);
  EXPECT_TRUE(robot_is_free());
}

TEST_F(FreePlaces, SidesSnapFlushOrBesideEachOther) {
  editor().add("block", Box{{0.2, 0.2, 0.2}}, {}, {-0.8, 0.0, 0.0});
  editor().add("brick", Box{{0.1, 0.1, 0.1}}, {}, {-0.643, 0.046, 0.004});
  const auto& q = window().document().configuration();
  EXPECT_TRUE(planning::shift_to_sides(scene(), q, {"brick"}, 0.01)
                  .isApprox(Vector3d(-0.007 + geometric::kRestingGap, 0.004, -0.004), 1e-9));
  EXPECT_TRUE(planning::shift_to_sides(scene(), q, {"brick"}, 0.001).isZero());
}

}  // namespace
}  // namespace handway::test
