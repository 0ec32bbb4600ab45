/// Guidance along a curve, without wires: a guide and an emulated device in simulated time.
#include "handway/device/haptic/force_guide.h"

#include "handway/device/emulators/haptic_emulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>

namespace handway::device {
namespace {

constexpr double kTick = 0.002;  // s

/// Returns half a circle of 0.4 m, in a plane.
std::shared_ptr<const ToolCurve> half_circle() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 100; ++i) {
    const double angle = std::numbers::pi * i / 100.0;
    points.emplace_back(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.5);
  }
  return std::make_shared<ToolCurve>(std::move(points));
}

/// A straight metre along x.
std::shared_ptr<const ToolCurve> straight() {
  return std::make_shared<ToolCurve>(
      std::vector<Eigen::Vector3d>{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
}

/// Settings in which the device's frame is the base's.
ForceGuideSettings unturned() {
  ForceGuideSettings settings;
  settings.R_BD.setIdentity();
  settings.scale = 2.0;
  return settings;
}

HapticSample held_at(const Eigen::Vector3d& position,
                     const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) {
  return {0.0, position, velocity, true};
}

TEST(ToolCurve, MeasuresByArcLength) {
  const ToolCurve curve({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 2.0, 0.0}});
  EXPECT_DOUBLE_EQ(curve.length(), 3.0);
  EXPECT_TRUE(curve.at(0.5).isApprox(Eigen::Vector3d(0.5, 0.0, 0.0)));
  EXPECT_TRUE(curve.at(2.0).isApprox(Eigen::Vector3d(1.0, 1.0, 0.0)));
  EXPECT_TRUE(curve.at(9.0).isApprox(Eigen::Vector3d(1.0, 2.0, 0.0)));
  EXPECT_EQ(curve.at(-1.0), Eigen::Vector3d::Zero());
  EXPECT_TRUE(curve.tangent(1.0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(curve.tangent(3.0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_DOUBLE_EQ(curve.nearest({0.4, 0.3, 0.0}, 0.0, 3.0), 0.4);
  EXPECT_DOUBLE_EQ(curve.nearest({0.4, 0.3, 0.0}, 1.5, 3.0), 1.5) << "only where it is asked";
  EXPECT_EQ(ToolCurve({{1.0, 2.0, 3.0}}).tangent(0.0), Eigen::Vector3d::Zero());
  EXPECT_THROW(ToolCurve({}), std::invalid_argument);
}

TEST(ForceGuide, PullsTowardsTheCurveBeyondItsTube) {
  ForceGuideSettings settings = unturned();
  settings.assistance = 0.0;
  ForceGuide guide(straight(), settings);
  guide.update(held_at(Eigen::Vector3d::Zero()), 0.0);
  EXPECT_EQ(guide.update(held_at({0.0, 0.002, 0.0}), 0.0).force, Eigen::Vector3d::Zero());
  const GuideStep step = guide.update(held_at({0.0, 0.013, 0.0}), 0.0);
  EXPECT_TRUE(step.force.isApprox(Eigen::Vector3d(0.0, -0.01 * settings.stiffness, 0.0), 1e-9));
  EXPECT_NEAR(step.deviation, 0.013, 1e-12);
  const GuideStep moving = guide.update(held_at({0.0, 0.0, 0.0}, {0.0, 0.0, 0.1}), 0.0);
  EXPECT_TRUE(moving.force.isApprox(Eigen::Vector3d(0.0, 0.0, -0.1 * settings.damping), 1e-9));
}

TEST(ForceGuide, HelpsAlongTheCurveAndNotBeyondItsEndOrSpeed) {
  const ForceGuideSettings settings = unturned();
  ForceGuide guide(straight(), settings);
  guide.update(held_at(Eigen::Vector3d::Zero()), 0.0);
  EXPECT_TRUE(guide.update(held_at(Eigen::Vector3d::Zero()), 0.0)
                  .force.isApprox(Eigen::Vector3d(settings.assistance, 0.0, 0.0), 1e-9));
  const GuideStep fast = guide.update(held_at({0.0, 0.0, 0.0}, {0.2, 0.0, 0.0}), 0.0);
  EXPECT_LT(fast.force.x(), 0.0) << "damped";
  for (double x = 0.0; x < 0.52; x += 0.01) {
    guide.update(held_at({x, 0.0, 0.0}), 2.0 * x);
  }
  EXPECT_DOUBLE_EQ(guide.progress(), 1.0);
  EXPECT_LE(guide.update(held_at({0.51, 0.0, 0.0}), 1.0).force.x(), 0.0) << "the end pulls back";
}

TEST(ForceGuide, HoldsTheHandThatLeavesTheRobotBehind) {
  ForceGuide guide(straight(), unturned());
  for (double x = 0.0; x < 0.05; x += 0.01) {
    guide.update(held_at({x, 0.0, 0.0}), 0.0);
  }
  EXPECT_LT(guide.update(held_at({0.05, 0.0, 0.0}), 0.0).force.x(), -1.0);
  EXPECT_GT(guide.update(held_at({0.05, 0.0, 0.0}), 0.1).force.x(), 0.5);
}

TEST(ForceGuide, GoesOnFromWhereTheButtonIsPressedAgain) {
  ForceGuide guide(straight(), unturned());
  for (double x = 0.0; x < 0.101; x += 0.01) {
    guide.update(held_at({x, 0.0, 0.0}), 2.0 * x);
  }
  EXPECT_NEAR(guide.progress(), 0.2, 1e-9);
  HapticSample open = held_at({-0.05, 0.01, 0.0});
  open.button = false;
  const GuideStep released = guide.update(open, 0.2);
  EXPECT_EQ(released.force, Eigen::Vector3d::Zero());
  EXPECT_FALSE(released.engaged);
  open.button = true;
  EXPECT_NEAR(guide.update(open, 0.2).progress, 0.2, 1e-9);
  EXPECT_NEAR(guide.update(open, 0.2).deviation, 0.0, 1e-9);
  EXPECT_EQ(guide.grips(), 2);
}

TEST(ForceGuide, IsBoundedWhateverTheSamplesSay) {
  ForceGuideSettings settings = unturned();
  settings.strongest = 2.5;
  ForceGuide guide(half_circle(), settings);
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(size * number(bits), size * number(bits), size * number(bits));
  };
  for (int i = 0; i < 20000; ++i) {
    HapticSample sample = held_at(vector(std::pow(10.0, 6.0 * number(bits))),
                                  vector(std::pow(10.0, 6.0 * number(bits))));
    sample.button = i % 50 != 0;
    if (i % 97 == 0) {
      sample.position[i % 3] = std::numeric_limits<double>::quiet_NaN();
    }
    const GuideStep step = guide.update(sample, 10.0 * number(bits));
    ASSERT_TRUE(step.force.allFinite());
    ASSERT_LE(step.force.norm(), settings.strongest * (1.0 + 1e-9));
    ASSERT_GE(step.progress, 0.0);
    ASSERT_LE(step.progress, half_circle()->length());
  }
}

TEST(ForceGuide, RefusesSettingsThatMakeNoSense) {
  ForceGuideSettings settings;
  settings.scale = 0.0;
  EXPECT_THROW(ForceGuide(straight(), settings), std::invalid_argument);
  settings = {};
  settings.R_BD(0, 0) = 3.0;
  EXPECT_THROW(ForceGuide(straight(), settings), std::invalid_argument);
  settings = {};
  settings.stiffness = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ForceGuide(straight(), settings), std::invalid_argument);
}

TEST(ForceGuide, GuidesAHandToTheGoalInItsTube) {
  EmulatedHaptic device({});
  EXPECT_THAT(device.receive("hello 1", 0.0), testing::StartsWith("hello 1 3.3"));
  const auto curve = half_circle();
  ForceGuide guide(curve, {});
  double worst = 0.0;
  double time = 0.0;
  for (; time < 120.0 && guide.progress() < curve->length() - 0.005; time += kTick) {
    device.advance(time);
    const GuideStep step = guide.update(device.sample(), guide.progress());
    EXPECT_EQ(
        device.receive(force_line(step.force).substr(0, force_line(step.force).size() - 1), time),
        "");
    worst = std::max(worst, step.deviation);
  }
  EXPECT_LT(time, 60.0) << "reached the goal";
  EXPECT_GT(guide.grips(), 1) << "1.26 m of the tool are 0.42 m of a hand with 0.16 m";
  EXPECT_LT(worst, 0.01) << "a trembling hand";
}

}  // namespace
}  // namespace handway::device
