#include "handway/planning/tasks/carried_object.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

Configuration joints(double arm, double finger) {
  Configuration q(2);
  q << arm, finger;
  return q;
}

// The palm, 1 m before the robot's base, is turned about the base's vertical by a right angle.
CarriedObjectMotion quarter_turn() {
  CarriedObjectMotion carried;
  const Pose before(Eigen::Translation3d(1.0, 0.0, 0.0));
  const Pose after(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()) * before);
  carried.motion.X_WP = {before, after};
  carried.moments = {{3, joints(0.0, 0.5)}, {4, joints(std::numbers::pi / 2, 0.5)}};
  return carried;
}

TEST(CarriedObject, IsSeenInTheWorldWhereTheArmIs) {
  const CarriedObjectMotion carried = quarter_turn();
  HoldFrame frame;
  frame.load = 1;
  frame.time = carried.motion.period;
  frame.q = joints(0.0, 0.6);
  frame.X_WO.translation() = Vector3d(1.1, 0.0, 0.2);
  frame.forces = {{Vector3d(1.1, 0.0, 0.2), Vector3d(2.0, 0.0, 1.0)}};
  EXPECT_EQ(stage_at(carried, frame), 4U);
  const HoldFrame seen = seen_in_world(carried, frame);
  EXPECT_TRUE(seen.q.isApprox(joints(std::numbers::pi / 2, 0.6))) << "simulated finger, moved arm";
  EXPECT_TRUE(seen.X_WO.translation().isApprox(Vector3d(0.0, 1.1, 0.2)));
  EXPECT_TRUE(seen.forces[0].p_W.isApprox(Vector3d(0.0, 1.1, 0.2)));
  EXPECT_TRUE(seen.forces[0].f_W.isApprox(Vector3d(0.0, 2.0, 1.0)));
}

TEST(CarriedObject, RestsDuringTheSqueezeAndAfterTheMotion) {
  const CarriedObjectMotion carried = quarter_turn();
  HoldFrame frame;
  frame.q = joints(0.0, 0.6);
  frame.time = 0.3;
  EXPECT_EQ(seen_in_world(carried, frame).q, frame.q);
  EXPECT_EQ(stage_at(carried, frame), 3U);
  frame.load = 1;
  EXPECT_EQ(stage_at(carried, frame), 4U);
}

}  // namespace
}  // namespace handway::planning
