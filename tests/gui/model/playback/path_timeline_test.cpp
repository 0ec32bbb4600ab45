#include "model/playback/path_timeline.h"

#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "small_cell.h"

#include <gtest/gtest.h>

namespace handway::test {
namespace {

class PathTimelines : public ::testing::Test {
 protected:
  // Makes a path from 0 by a quarter of the motion to the second waypoint, then the rest.
  PathTimelines() {
    const SmallCell cell;
    model_ = planning::load_scene(cell.post(), {}).scene->robots.front().model;
    const geometric::Configuration a = model_->neutral();
    geometric::Configuration b = a, c = a;
    b[1] = 0.5;
    c[1] = 2.0;
    planning::Path path;
    path.waypoints = {a, b, c};
    timeline_ = gui::PathTimeline(*model_, path);
  }

  std::shared_ptr<const geometric::RobotModel> model_;
  gui::PathTimeline timeline_;
};

TEST_F(PathTimelines, MoveAtEvenSpeed) {
  EXPECT_DOUBLE_EQ(timeline_.at(0.25)[1], 0.5);
  EXPECT_DOUBLE_EQ(timeline_.at(0.5)[1], 1.0);
  EXPECT_DOUBLE_EQ(timeline_.at(1.0)[1], 2.0);
}

TEST_F(PathTimelines, StayWithinTheirEnds) {
  EXPECT_EQ(timeline_.at(-1.0), timeline_.path().waypoints.front());
  EXPECT_EQ(timeline_.at(2.0), timeline_.path().waypoints.back());
}

TEST_F(PathTimelines, KnowTheNextWaypointAndTheOneBefore) {
  EXPECT_DOUBLE_EQ(timeline_.next_waypoint(0.0), 0.25);
  EXPECT_DOUBLE_EQ(timeline_.next_waypoint(0.25), 1.0);
  EXPECT_DOUBLE_EQ(timeline_.previous_waypoint(0.6), 0.25);
  EXPECT_DOUBLE_EQ(timeline_.previous_waypoint(0.0), 0.0);
}

}  // namespace
}  // namespace handway::test
