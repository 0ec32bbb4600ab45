#include "handway/device/glove/hand_exploration.h"

#include "handway/device/emulators/glove_signals.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/principal_components.h"

#include <gtest/gtest.h>

#include <array>

namespace handway::device {
namespace {

constexpr int kSamples = 13500;  // Number in the paper's section 4.2.

// A joint of the SAH hand and the sensor that moves it (paper, Table 1), with the angles of the
// sensor at both ends of the joint, deg: the joint's own range, turned so that all flexions count
// down as the hand's joints do. Joint 7 keeps to its middle.
struct MappedJoint {
  int sensor;
  double at_0;
  double at_1;
};
constexpr std::array<MappedJoint, 13> kTable1{{{0, 90, 0},
                                               {0, 90, 0},
                                               {1, 75, -4},
                                               {2, 75, 4},
                                               {10, 15, -15},
                                               {4, 75, -4},
                                               {5, 75, 4},
                                               {-1, 0, 1},
                                               {7, 75, -4},
                                               {8, 75, 4},
                                               {14, -15, 15},
                                               {11, 75, -4},
                                               {12, 75, 4}}};

double normalised(const GloveAngles& angles, const MappedJoint& joint) {
  if (joint.sensor < 0) {
    return 0.5;
  }
  const double angle = geometric::degrees(angles.angles[static_cast<std::size_t>(joint.sensor)]);
  return std::clamp((angle - joint.at_0) / (joint.at_1 - joint.at_0), 0.0, 1.0);
}

Eigen::MatrixXd postures(std::uint64_t seed) {
  HandExploration hand(seed);
  Eigen::MatrixXd samples(kSamples, 13);
  for (int row = 0; row < kSamples; ++row) {
    const GloveAngles angles = hand.at(0.01 * row);
    for (std::size_t joint = 0; joint < kTable1.size(); ++joint) {
      samples(row, static_cast<Eigen::Index>(joint)) = normalised(angles, kTable1[joint]);
    }
  }
  return samples;
}

double correlation(const Eigen::MatrixXd& samples, int a, int b) {
  const Eigen::VectorXd x = samples.col(a).array() - samples.col(a).mean();
  const Eigen::VectorXd y = samples.col(b).array() - samples.col(b).mean();
  return x.dot(y) / (x.norm() * y.norm());
}

class ExploredPostures : public testing::TestWithParam<int> {};

TEST_P(ExploredPostures, HaveThePapersSharesOfVariance) {
  const Eigen::MatrixXd samples = postures(static_cast<std::uint64_t>(GetParam()));
  const Eigen::VectorXd shares = sampling::principal_components(samples).shares;
  EXPECT_NEAR(shares.head(1).sum(), 0.4219, 0.03);
  EXPECT_NEAR(shares.head(2).sum(), 0.7712, 0.03);
  EXPECT_NEAR(shares.head(3).sum(), 0.8471, 0.03);
}

TEST_P(ExploredPostures, HaveTheCorrelationsOfThePapersFigure7) {
  const Eigen::MatrixXd samples = postures(static_cast<std::uint64_t>(GetParam()));
  EXPECT_GT(correlation(samples, 8, 11), 0.5);
  EXPECT_LT(correlation(samples, 4, 10), -0.4);
  EXPECT_GT(correlation(samples, 6, 9), 0.5);
  EXPECT_GT(correlation(samples, 8, 10), 0.3);
  EXPECT_NEAR(correlation(samples, 0, 5), 0.0, 0.2);
  EXPECT_NEAR(correlation(samples, 0, 12), 0.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExploredPostures, testing::Values(1, 2, 7));

TEST(HandExploration, GivesTheSameMotionForTheSameSeed) {
  HandExploration a(5);
  HandExploration b(5);
  HandExploration other(6);
  bool differs = false;
  for (int k = 0; k < 500; ++k) {
    const auto angles = a.at(0.01 * k).angles;
    EXPECT_EQ(angles, b.at(0.01 * k).angles);
    differs |= angles != other.at(0.01 * k).angles;
  }
  EXPECT_TRUE(differs);
}

TEST(HandExploration, DoesNotDependOnHowOftenItIsLookedAt) {
  HandExploration often(5);
  HandExploration seldom(5);
  for (int k = 0; k <= 1000; ++k) {
    const auto angles = often.at(0.01 * k).angles;
    if (k % 100 == 0) {
      EXPECT_EQ(angles, seldom.at(0.01 * k).angles);
    }
  }
}

TEST(HandExploration, MovesAsSmoothlyAndAsFastAsAHand) {
  HandExploration hand(1);
  GloveAngles former = hand.at(0.0);
  double fastest = 0.0;
  for (int k = 1; k < kSamples; ++k) {
    const GloveAngles angles = hand.at(0.01 * k);
    for (const std::size_t sensor : {4U, 5U, 7U, 8U, 11U, 12U}) {
      fastest = std::max(fastest, std::abs(angles.angles[sensor] - former.angles[sensor]) / 0.01);
    }
    former = angles;
  }
  EXPECT_GT(fastest, 2.0);   // rad/s
  EXPECT_LT(fastest, 12.0);  // Fast human fingers reach 10 and more.
}

TEST(HandExploration, BendsDistalJointsTwoThirdsAsFarAsMedialOnes) {
  HandExploration hand(1);
  for (int k = 0; k < 1000; ++k) {
    const auto angles = hand.at(0.05 * k).angles;
    EXPECT_NEAR(angles[6], 2.0 / 3.0 * angles[5], 1e-9);
    EXPECT_NEAR(angles[17], 2.0 / 3.0 * angles[16], 1e-9);
  }
}

TEST(ExploringHandSignal, UsesTheScaleWithoutLeavingIt) {
  const GloveSignal signal = exploring_hand_signal(1);
  std::array<std::uint16_t, kGloveSensors> low{};
  std::array<std::uint16_t, kGloveSensors> high{};
  low.fill(255);
  for (int k = 0; k < kSamples; ++k) {
    const auto counts = signal(0.01 * k);
    for (std::size_t sensor = 0; sensor < counts.size(); ++sensor) {
      low[sensor] = std::min(low[sensor], counts[sensor]);
      high[sensor] = std::max(high[sensor], counts[sensor]);
    }
  }
  for (std::size_t sensor = 0; sensor < low.size(); ++sensor) {
    EXPECT_GT(low[sensor], 1) << sensor;
    EXPECT_LT(high[sensor], 255) << sensor;
    EXPECT_GT(high[sensor] - low[sensor], 15) << sensor;
  }
}

TEST(ExploringHandSignal, SaturatesTheSensorsThatItIsToldTo) {
  SensorFaults faults;
  faults.saturated = {4};
  const auto counts = exploring_hand_signal(1, faults)(0.0);
  EXPECT_EQ(counts[4], 255);
  EXPECT_LT(counts[5], 255);
}

}  // namespace
}  // namespace handway::device
