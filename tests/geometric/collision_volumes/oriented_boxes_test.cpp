#include "collision/broad_phase/oriented_boxes.h"

#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace handway::geometric {
namespace {

// Robot, placed.
class Placed {
 public:
  Placed() : checker_(std::make_shared<const CollisionWorld>(scene())) {}

  void place(const Configuration& q) {
    checker_.place(q);
    std::vector<Pose> X_BL(static_cast<std::size_t>(world().model().link_count()));
    X_WBody_.resize(world().bodies().size());
    world().place(q, X_BL, X_WBody_);
  }

  [[nodiscard]] const CollisionWorld& world() const { return checker_.world(); }
  [[nodiscard]] FclChecker& checker() { return checker_; }
  [[nodiscard]] const std::vector<Pose>& poses() const { return X_WBody_; }
  [[nodiscard]] int pair_count() const { return static_cast<int>(world().pairs().size()); }

 private:
  static Scene scene() {
    Scene scene = handway::test::scene_of(handway::test::solid_tx90_sah());
    handway::test::add_object(scene, "board", Box{{0.4, 0.8, 0.02}},
                              pose_from_rpy({0.6, 0.1, 0.7}, 0.4, -0.3, 0.7));
    return scene;
  }

  FclChecker checker_;
  std::vector<Pose> X_WBody_;
};

TEST(OrientedBoxes, AreNeverFartherApartThanTheBodies) {
  Placed robot;
  const OrientedBoxes boxes(robot.world());
  OrientedBoxes::LastAxes last = boxes.last_axes();
  handway::test::RandomConfigurations random(robot.world().model(), 1);
  int apart = 0;
  for (int i = 0; i < 30; ++i) {
    robot.place(random.next());
    for (int pair = 0; pair < robot.pair_count(); ++pair) {
      for (const double distance : {1e-9, 0.005, 0.1}) {
        if (boxes.are_apart(pair, robot.poses(), distance, last)) {
          ++apart;
          ASSERT_GE(robot.checker().pair_distance(pair, 2.0 * distance), distance);
        }
      }
    }
  }
  EXPECT_GT(apart, 1000);
}

TEST(OrientedBoxes, AnswerTheSameWhicheverAxisPartedThemLast) {
  Placed robot;
  const OrientedBoxes boxes(robot.world());
  OrientedBoxes::LastAxes used = boxes.last_axes();
  handway::test::RandomConfigurations random(robot.world().model(), 2);
  for (int i = 0; i < 30; ++i) {
    robot.place(random.next());
    for (int pair = 0; pair < robot.pair_count(); ++pair) {
      OrientedBoxes::LastAxes fresh = boxes.last_axes();
      EXPECT_EQ(boxes.are_apart(pair, robot.poses(), 0.01, used),
                boxes.are_apart(pair, robot.poses(), 0.01, fresh));
    }
  }
}

}  // namespace
}  // namespace handway::geometric
