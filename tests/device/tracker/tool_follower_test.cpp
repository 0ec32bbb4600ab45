#include "handway/device/tracker/tool_follower.h"

#include "handway/device/emulators/tracker_signals.h"
#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace handway::device {
namespace {

using geometric::Configuration;
using geometric::Pose;

constexpr double kPeriod = 1.0 / 120.0;

class FollowedTx90 : public testing::Test {
 protected:
  [[nodiscard]] ToolFollower follower(const ToolFollowerSettings& settings = {}) const {
    return {ik_, start_, settings};
  }

  static ToolFollowerSettings direct() {
    ToolFollowerSettings settings;
    settings.smoothing = 0.0;
    settings.top_speed = 10.0;
    return settings;
  }

  [[nodiscard]] Pose tool_at(const Configuration& q) const {
    return ToolFollower(ik_, q).tool_pose();
  }

  std::shared_ptr<const geometric::RobotModel> model_ =
      std::make_shared<geometric::RobotModel>(test::tx90_urdf_style());
  std::shared_ptr<const geometric::SphericalWristInverseKinematics> ik_ =
      geometric::make_spherical_wrist_inverse_kinematics(model_, "flange");
  Configuration start_ = (Configuration(6) << 0.2, 0.4, 1.6, 0.3, 0.9, 0.1).finished();
};

TrackerSample sample_at(double time, const Eigen::Vector3d& p, double yaw = 0.0) {
  return {time, 1, geometric::pose_from_rpy(p, 0.0, 0.0, yaw), {}};
}

Eigen::Vector3d on_circle(double time) {
  const double angle = 2.0 * std::numbers::pi * time / 4.0;
  return 0.1 * Eigen::Vector3d(0.0, std::sin(angle), std::cos(angle));
}

TEST_F(FollowedTx90, DrawsACircleExactlyWithoutSmoothing) {
  ToolFollower follower = this->follower(direct());
  const Eigen::Vector3d begin = follower.tool_pose().translation();
  follower.engage();
  for (int k = 0; k < 960; ++k) {
    const double time = k * kPeriod;
    const FollowStep step = follower.update(sample_at(time, on_circle(time)));
    ASSERT_EQ(step.state, FollowState::kFollowing) << step.reason;
    const Eigen::Vector3d wanted = begin + on_circle(time) - on_circle(0.0);
    ASSERT_LT((tool_at(step.q).translation() - wanted).norm(), 1e-9);
  }
}

TEST_F(FollowedTx90, DrawsACircleWithinACentimetreWithTheUsualSettings) {
  ToolFollower follower = this->follower();
  const Eigen::Vector3d begin = follower.tool_pose().translation();
  follower.engage();
  for (int k = 0; k < 960; ++k) {
    const double time = k * kPeriod;
    const FollowStep step = follower.update(sample_at(time, on_circle(time)));
    const Eigen::Vector3d wanted = begin + on_circle(time) - on_circle(0.0);
    // It lags by the speed of 0.157 m/s times 0.05 s.
    ASSERT_LT((tool_at(step.q).translation() - wanted).norm(), 0.01);
  }
}

TEST_F(FollowedTx90, ScalesAndTurnsTheHandsWay) {
  ToolFollowerSettings settings = direct();
  settings.translation_scale = 0.5;
  settings.R_BS = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).matrix();
  ToolFollower follower = this->follower(settings);
  const Pose begin = follower.tool_pose();
  follower.engage();
  follower.update(sample_at(0.0, {1.0, 2.0, 3.0}, 0.4));
  const FollowStep step = follower.update(sample_at(0.1, {1.1, 2.0, 3.0}, 0.6));
  const Pose end = tool_at(step.q);
  EXPECT_TRUE(
      (end.translation() - begin.translation()).isApprox(Eigen::Vector3d(0, 0.05, 0), 1e-6));
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(end.linear() * begin.linear().transpose()));
  EXPECT_NEAR(turn.angle(), 0.2, 1e-9);
  EXPECT_TRUE(turn.axis().isApprox(Eigen::Vector3d::UnitZ(), 1e-6));
}

TEST_F(FollowedTx90, KeepsItsOrientationWhenToldNotToTurn) {
  ToolFollowerSettings settings = direct();
  settings.rotate = false;
  ToolFollower follower = this->follower(settings);
  const Pose begin = follower.tool_pose();
  follower.engage();
  follower.update(sample_at(0.0, Eigen::Vector3d::Zero()));
  const FollowStep step = follower.update(sample_at(0.1, {0.02, 0.0, 0.0}, 1.0));
  EXPECT_TRUE(tool_at(step.q).linear().isApprox(begin.linear(), 1e-9));
}

TEST_F(FollowedTx90, DoesNotJumpWhenTheClutchIsOpenedAndClosed) {
  ToolFollower follower = this->follower(direct());
  EXPECT_EQ(follower.update(sample_at(0.0, {9.0, 9.0, 0.0})).q, start_);
  follower.engage();
  EXPECT_TRUE(follower.update(sample_at(0.1, Eigen::Vector3d::Zero())).q.isApprox(start_, 1e-9));
  const Configuration moved = follower.update(sample_at(0.2, {0.05, 0.05, 0.0}, 0.3)).q;
  EXPECT_FALSE(moved.isApprox(start_, 1e-3));
  follower.disengage();
  const FollowStep stands = follower.update(sample_at(0.3, {0.4, -0.3, 0.2}, -1.0));
  EXPECT_EQ(stands.state, FollowState::kReleased);
  EXPECT_EQ(stands.q, moved);
  follower.engage();
  EXPECT_TRUE(follower.update(sample_at(0.4, {0.6, -0.3, 0.2}, -2.0)).q.isApprox(moved, 1e-9));
  const Pose before = follower.tool_pose();
  const FollowStep after = follower.update(sample_at(0.5, {0.6, -0.3, 0.22}, -2.0));
  EXPECT_NEAR((tool_at(after.q).translation() - before.translation()).z(), 0.02, 1e-9);
}

TEST_F(FollowedTx90, OpensTheClutchWhenTheTrackerWasSilent) {
  ToolFollower follower = this->follower();
  follower.engage();
  follower.update(sample_at(0.0, Eigen::Vector3d::Zero()));
  const FollowStep step = follower.update(sample_at(1.0, {0.3, 0.0, 0.0}));
  EXPECT_EQ(step.state, FollowState::kReleased);
  EXPECT_THAT(step.reason, testing::HasSubstr("silent"));
  EXPECT_EQ(step.q, start_);
  EXPECT_FALSE(follower.engaged());
}

TEST_F(FollowedTx90, StaysInItsWorkspace) {
  ToolFollowerSettings settings = direct();
  const Eigen::Vector3d begin = follower().tool_pose().translation();
  settings.workspace.box = {begin - Eigen::Vector3d::Constant(0.05),
                            begin + Eigen::Vector3d::Constant(0.05)};
  settings.workspace.reach_centre = begin;
  settings.workspace.reach = 0.06;
  ToolFollower follower = this->follower(settings);
  follower.engage();
  bool edge = false;
  for (int k = 0; k < 480; ++k) {
    const double time = k * kPeriod;
    const FollowStep step = follower.update(sample_at(time, on_circle(time)));
    const Eigen::Vector3d off = tool_at(step.q).translation() - begin;
    ASSERT_LE(off.cwiseAbs().maxCoeff(), 0.05 + 1e-6);
    ASSERT_LE(off.norm(), 0.06 + 1e-5);
    edge |= step.at_workspace_edge;
  }
  EXPECT_TRUE(edge);
}

TEST_F(FollowedTx90, HoldsWhereTheHandLeavesItsReachAndGoesOnWhenItIsBack) {
  ToolFollower follower = this->follower(direct());
  follower.engage();
  FollowStep step;
  Configuration last = start_;
  bool held = false;
  double time = 0.0;
  // The hand moves two metres out and back.
  for (int k = 0; k <= 2400; ++k, time += kPeriod) {
    const double way = k <= 1200 ? k / 600.0 : (2400 - k) / 600.0;
    step = follower.update(sample_at(time, {way, 0.0, 0.0}));
    if (step.state == FollowState::kOutOfReach) {
      EXPECT_FALSE(step.reason.empty());
      EXPECT_EQ(step.q, last);
      held = true;
    }
    last = step.q;
  }
  EXPECT_TRUE(held);
  EXPECT_EQ(step.state, FollowState::kFollowing);
  EXPECT_LT((tool_at(step.q).translation() - tool_at(start_).translation()).norm(), 1e-6);
}

TEST_F(FollowedTx90, NeverMovesFasterThanAllowedWhateverTheHandDoes) {
  ToolFollowerSettings settings;
  settings.translation_scale = 3.0;
  settings.top_speed = 0.7;
  std::set<FollowState> seen;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    ToolFollower follower = this->follower(settings);
    const TrackerSignal hand = wrist_motion_signal(seed, {0.002, 0.02});
    follower.engage();
    Configuration last = start_;
    for (int k = 0; k < 3600; ++k) {
      const double time = k * kPeriod;
      // Now and then the tracker reports an absurd pose.
      const Pose X_ST = k % 97 == 96 ? Pose(Eigen::Translation3d(5.0, 5.0, 5.0)) : hand(time, 1);
      const FollowStep step = follower.update({time, 1, X_ST, {}});
      seen.insert(step.state);
      ASSERT_LE((step.q - last).cwiseAbs().maxCoeff(), 0.7 * kPeriod + 1e-9);
      ASSERT_TRUE((step.q.array() >= model_->lower().array() - 1e-9).all());
      ASSERT_TRUE((step.q.array() <= model_->upper().array() + 1e-9).all());
      last = step.q;
    }
  }
  EXPECT_TRUE(seen.contains(FollowState::kSlowed));
  EXPECT_TRUE(seen.contains(FollowState::kOutOfReach));
}

TEST_F(FollowedTx90, PassesAStretchedWristWithoutTurningOver) {
  start_ << 0.0, 0.4, 1.6, 0.0, 0.3, 0.0;
  ToolFollowerSettings settings = direct();
  settings.top_speed = 2.0;
  ToolFollower follower = this->follower(settings);
  const Pose begin = follower.tool_pose();
  follower.engage();
  // Turned about axis 5, through the pose with axes 4 and 6 in line, a little beside it.
  const Eigen::Vector3d axis =
      (Eigen::Vector3d::UnitY() + Eigen::Vector3d(0.002, 0, 0)).normalized();
  Configuration last = start_;
  for (int k = 0; k <= 240; ++k) {
    Pose X_ST = Pose::Identity();
    X_ST.linear() = Eigen::AngleAxisd(-0.6 * k / 240.0, axis).toRotationMatrix();
    X_ST.translation() = X_ST.linear() * begin.translation() - begin.translation();
    const FollowStep step = follower.update({k * kPeriod, 1, X_ST, {}});
    ASSERT_LE((step.q - last).cwiseAbs().maxCoeff(), 2.0 * kPeriod + 1e-9);
    last = step.q;
  }
}

TEST_F(FollowedTx90, RefusesSettingsThatMakeNoSense) {
  const auto refused = [&](auto change) {
    ToolFollowerSettings settings;
    change(settings);
    EXPECT_THROW((void)follower(settings), std::invalid_argument);
  };
  refused([](auto& s) { s.R_BS *= 2.0; });
  refused([](auto& s) { s.translation_scale = -1.0; });
  refused([](auto& s) { s.smoothing = std::nan(""); });
  refused([](auto& s) { s.top_speed = 0.0; });
  refused([](auto& s) { s.workspace.reach = -1.0; });
  refused([](auto& s) { s.workspace.box.setEmpty(); });
  refused([](auto& s) {
    s.workspace.box = {Eigen::Vector3d::Constant(1.0), Eigen::Vector3d::Constant(2.0)};
    s.workspace.reach = 0.5;
  });
  EXPECT_THROW(ToolFollower(ik_, Configuration::Zero(5)), std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
