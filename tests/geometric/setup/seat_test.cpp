#include <handway/geometric/setup/seat.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using Eigen::Vector3d;

class Robot {
 public:
  explicit Robot(const std::string& root) { robot_.links.push_back({root, {}, {}}); }

  Robot& joint(const std::string& parent, const std::string& child, const Vector3d& xyz,
               const Vector3d& axis, const Vector3d& rpy = Vector3d::Zero()) {
    robot_.links.push_back({child, {}, {}});
    Joint joint;
    joint.name = child + "_joint";
    joint.type = axis.isZero() ? JointType::kFixed : JointType::kRevolute;
    joint.parent = parent;
    joint.child = child;
    joint.axis = axis.isZero() ? Vector3d::UnitX() : axis;
    joint.limits = {-1.0, 1.0, 1.0};
    joint.X_PJ.translation() = xyz;
    joint.X_PJ.linear() = (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                           Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
                              .toRotationMatrix();
    robot_.joints.push_back(joint);
    return *this;
  }
  Robot& fixed(const std::string& parent, const std::string& child, const Vector3d& xyz,
               const Vector3d& rpy = Vector3d::Zero()) {
    return joint(parent, child, xyz, Vector3d::Zero(), rpy);
  }
  /// The last link is a cube of 0.1 m.
  Robot& cube() {
    robot_.links.back().collision.emplace_back().shape = Box{{0.1, 0.1, 0.1}};
    return *this;
  }

  [[nodiscard]] RobotModel model() const { return RobotModel(robot_); }

 private:
  RobotDescription robot_;
};

const Vector3d kX = Vector3d::UnitX();
const Vector3d kY = Vector3d::UnitY();
const Vector3d kZ = Vector3d::UnitZ();

/// An arm whose last joint turns about the axis that points out of its flange.
Robot arm() {
  return Robot("base")
      .joint("base", "lower", 0.3 * kZ, kY)
      .joint("lower", "upper", 0.3 * kZ, kY)
      .joint("upper", "flange", 0.1 * kZ, kZ);
}

/// Two fingers on a palm that reaches 0.05 m behind its frame.
Robot hand(const Vector3d& fingers) {
  return Robot("palm")
      .cube()
      .joint("palm", "a", 0.1 * fingers, kY)
      .joint("palm", "b", 0.1 * fingers, kY);
}

TEST(Seat, IsOnTheFlangeJustInFrontOfIt) {
  const Seat seat = find_seat(arm().model(), hand(kZ).model()).value();
  EXPECT_EQ(seat.link, "flange");
  EXPECT_TRUE(seat.X_LB.linear().isIdentity(1e-12));
  EXPECT_TRUE(seat.X_LB.translation().isApprox(0.05 * kZ, 1e-12));
}

TEST(Seat, LeavesWhatBeginsAtItsRootThere) {
  const RobotModel tool = Robot("tool").fixed("tool", "blade", 0.05 * kZ).cube().model();
  EXPECT_TRUE(find_seat(arm().model(), tool)->X_LB.isApprox(Pose::Identity(), 1e-12));
}

TEST(Seat, PointsOutOfTheArmWhateverTheTipsAxes) {
  const RobotModel turned =
      arm().fixed("flange", "tool", Vector3d::Zero(), {0.0, -std::acos(0.0), 0.0}).model();
  const Seat seat = find_seat(turned, hand(kZ).model()).value();
  EXPECT_EQ(seat.link, "tool");
  EXPECT_TRUE(seat.X_LB.translation().isApprox(0.05 * kX, 1e-12));
  EXPECT_TRUE((seat.X_LB.linear() * kZ).isApprox(kX, 1e-12));
}

TEST(Seat, PointsAwayFromTheArmWhereTheLastAxisPointsBack) {
  const RobotModel back = Robot("base")
                              .joint("base", "lower", 0.3 * kZ, kY)
                              .joint("lower", "flange", 0.3 * kZ, -kZ)
                              .model();
  EXPECT_TRUE((find_seat(back, hand(kZ).model())->X_LB.linear() * kZ).isApprox(kZ, 1e-12));
}

TEST(Seat, GoesOnAlongAForearmThatEndsTheArm) {
  const RobotModel elbow = Robot("base")
                               .joint("base", "lower", 0.3 * kZ, kY)
                               .joint("lower", "forearm", 0.3 * kZ, kY)
                               .fixed("forearm", "end", 0.2 * kX)
                               .model();
  const Seat seat = find_seat(elbow, hand(kZ).model()).value();
  EXPECT_EQ(seat.link, "end");
  EXPECT_TRUE((seat.X_LB.linear() * kZ).isApprox(kX, 1e-12));
}

TEST(Seat, TurnsTheFingersForward) {
  const Seat seat = find_seat(arm().model(), hand(-kY).model()).value();
  EXPECT_TRUE((seat.X_LB.linear() * -kY).isApprox(kZ, 1e-12));
  EXPECT_TRUE(seat.X_LB.translation().isApprox(0.05 * kZ, 1e-12));
}

TEST(Seat, IsOnlyAtTheOneEndOfAnArm) {
  const RobotModel table = Robot("table").model();
  const RobotModel two_arms = arm()
                                  .joint("base", "other_lower", 0.5 * kY, kX)
                                  .joint("other_lower", "other", 0.5 * kY, kX)
                                  .model();
  for (const RobotModel& carrier : {table, two_arms, hand(kZ).model()}) {
    EXPECT_FALSE(find_seat(carrier, hand(kZ).model()));
  }
}

}  // namespace
}  // namespace handway::geometric
