#include "handway/geometric/setup/hand_eye.h"

#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Pose kCamera = pose_from_rpy({0.05, -0.02, 0.09}, 0.1, -0.2, 1.4);
const Pose kTarget = pose_from_rpy({0.6, 0.1, 0.02}, 3.0, 0.1, -0.4);

double angle_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

/// Noise of measurements, as standard deviations.
struct Noise {
  double position = 0.0;  ///< m.
  double angle = 0.0;     ///< rad.
};

class Measuring {
 public:
  explicit Measuring(Noise noise, std::uint64_t seed = 1) : noise_(noise), random_(seed) {}

  Eigen::Vector3d vector(double scale) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const double x = normal(random_);
    const double y = normal(random_);
    return scale * Eigen::Vector3d(x, y, normal(random_));
  }
  Pose disturbed(const Pose& X) {
    Pose result = X;
    result.translation() += vector(noise_.position);
    result.linear() = X.linear() * turn_from_rotation_vector(vector(noise_.angle)).matrix();
    return result;
  }
  /// A posture of the hand; its axes of rotation differ.
  Pose hand() {
    return pose_from_rpy(Eigen::Vector3d(0.5, 0.0, 0.5) + vector(0.1), vector(0.4).x() + 3.0,
                         vector(0.4).x(), vector(0.4).x());
  }

 private:
  Noise noise_;
  std::mt19937_64 random_;
};

std::vector<HandEyePair> pairs_of(CameraMount mount, int count, Noise noise = {}) {
  Measuring measuring(noise);
  std::vector<HandEyePair> pairs;
  for (int i = 0; i < count; ++i) {
    const Pose X_BH = measuring.hand();
    const Pose X_CT = mount == CameraMount::kOnHand ? kCamera.inverse() * X_BH.inverse() * kTarget
                                                    : kCamera.inverse() * X_BH * kTarget;
    pairs.push_back({X_BH, measuring.disturbed(X_CT), "pair " + std::to_string(i + 1)});
  }
  return pairs;
}

std::string refusal_of_pairs(const std::vector<HandEyePair>& pairs) {
  return test::refusal_of(
      [&] { static_cast<void>(calibrate_hand_eye(pairs, CameraMount::kOnHand)); });
}

TEST(HandEye, FindsTheCameraExactlyWithoutNoise) {
  for (const CameraMount mount : {CameraMount::kOnHand, CameraMount::kFixed}) {
    for (const int count : {3, 4, 10}) {
      const CameraCalibration found = calibrate_hand_eye(pairs_of(mount, count), mount);
      EXPECT_TRUE(found.X_AC.isApprox(kCamera, 1e-8)) << count;
      EXPECT_TRUE(found.X_target.isApprox(kTarget, 1e-8)) << count;
      EXPECT_EQ(found.used, count);
      EXPECT_LT(found.rms_position, 1e-8);
      EXPECT_LT(found.rms_angle, 1e-7);
    }
  }
}

TEST(HandEye, IsAboutAsGoodAsItsMeasurements) {
  const Noise noise{0.5e-3, 0.2 * kDegree};
  for (const CameraMount mount : {CameraMount::kOnHand, CameraMount::kFixed}) {
    const CameraCalibration found = calibrate_hand_eye(pairs_of(mount, 20, noise), mount);
    EXPECT_LT((found.X_AC.translation() - kCamera.translation()).norm(), 8e-3);
    EXPECT_LT(angle_between(found.X_AC, kCamera), 0.5 * kDegree);
    EXPECT_GT(found.rms_angle, 0.05 * kDegree);
    EXPECT_LT(found.rms_angle, 1.0 * kDegree);
    EXPECT_GE(found.used, 18);
  }
}

TEST(HandEye, NamesAndLeavesOutPairsThatContradictTheOthers) {
  std::vector<HandEyePair> pairs = pairs_of(CameraMount::kFixed, 10, {0.2e-3, 0.05 * kDegree});
  pairs[3].X_CT.translation().x() += 0.05;
  pairs[7].X_BH = pairs[6].X_BH;  // read too early
  const CameraCalibration found = calibrate_hand_eye(pairs, CameraMount::kFixed);
  ASSERT_EQ(found.residuals.size(), 10U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(found.residuals[i].is_outlier, i == 3 || i == 7) << pairs[i].place;
    EXPECT_EQ(found.residuals[i].place, pairs[i].place);
  }
  EXPECT_GT(found.residuals[3].position, 0.04);
  EXPECT_EQ(found.used, 8);
  EXPECT_LT((found.X_AC.translation() - kCamera.translation()).norm(), 2e-3);

  CameraCalibrationSettings keep;
  keep.leaves_out_outliers = false;
  const CameraCalibration all = calibrate_hand_eye(pairs, CameraMount::kFixed, keep);
  EXPECT_EQ(all.used, 10);
  EXPECT_GT((all.X_AC.translation() - kCamera.translation()).norm(), 2e-3);
}

TEST(HandEye, GivesEqualBits) {
  const auto pairs = pairs_of(CameraMount::kOnHand, 30, {1e-3, 0.01});  // triples are drawn
  EXPECT_EQ(calibrate_hand_eye(pairs, CameraMount::kOnHand).X_AC.matrix(),
            calibrate_hand_eye(pairs, CameraMount::kOnHand).X_AC.matrix());
}

TEST(HandEye, RefusesTooFewPairs) {
  EXPECT_THAT(refusal_of_pairs(pairs_of(CameraMount::kOnHand, 2)),
              AllOf(HasSubstr("2 pose pairs"), HasSubstr("3 or more")));
  EXPECT_THAT(refusal_of_pairs({}), HasSubstr("3 or more"));
}

TEST(HandEye, RefusesTurnsAboutParallelAxes) {
  for (const double noise : {0.0, 0.2 * kDegree}) {
    Measuring measuring({0.2e-3, noise});
    std::vector<HandEyePair> pairs;
    for (int i = 0; i < 8; ++i) {
      const Pose X_BH = pose_from_rpy({0.5, 0.02 * i, 0.4}, 3.1, 0.1, 0.25 * i);
      pairs.push_back(
          {X_BH, measuring.disturbed(kCamera.inverse() * X_BH.inverse() * kTarget), "pair"});
    }
    // About the base's z alone.
    for (HandEyePair& pair : pairs) {
      ASSERT_NEAR(pair.X_BH.linear()(2, 2), pairs[0].X_BH.linear()(2, 2), 1e-9);
    }
    EXPECT_THAT(refusal_of_pairs(pairs),
                AllOf(HasSubstr("parallel axes"), HasSubstr("Turn the hand by 20")));
  }
}

TEST(HandEye, RefusesAHandThatDoesNotTurn) {
  std::vector<HandEyePair> pairs;
  for (int i = 0; i < 5; ++i) {
    const Pose X_BH = pose_from_rpy({0.5, 0.1 * i, 0.4}, 3.1, 0.0, 0.0);
    pairs.push_back({X_BH, kCamera.inverse() * X_BH.inverse() * kTarget, "pair"});
  }
  EXPECT_THAT(refusal_of_pairs(pairs), HasSubstr("turns by 0"));
}

std::vector<TouchedPoint> touched(int count, double noise = 0.0) {
  Measuring measuring({noise, 0.0});
  std::vector<TouchedPoint> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p_A = Eigen::Vector3d(0.5, 0.0, 0.2) + measuring.vector(0.2);
    points.push_back(
        {p_A, kCamera.inverse() * p_A + measuring.vector(noise), "point " + std::to_string(i + 1)});
  }
  return points;
}

TEST(TouchedPoints, GiveTheCamerasPose) {
  for (const int count : {3, 4, 12}) {
    const CameraCalibration found = calibrate_camera_by_points(touched(count));
    EXPECT_TRUE(found.X_AC.isApprox(kCamera, 1e-9)) << count;
    EXPECT_LT(found.rms_position, 1e-9);
    EXPECT_EQ(found.rms_angle, 0.0);
  }
  const CameraCalibration noisy = calibrate_camera_by_points(touched(12, 1e-3));
  EXPECT_LT((noisy.X_AC.translation() - kCamera.translation()).norm(), 3e-3);
  EXPECT_NEAR(noisy.rms_position, std::sqrt(3.0) * 1e-3, 1e-3);
}

TEST(TouchedPoints, NameThoseThatContradictTheOthers) {
  std::vector<TouchedPoint> points = touched(8, 0.3e-3);
  points[5].p_C.y() += 0.03;
  const CameraCalibration found = calibrate_camera_by_points(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(found.residuals[i].is_outlier, i == 5) << i;
  }
  EXPECT_NEAR(found.residuals[5].position, 0.03, 2e-3);
}

TEST(TouchedPoints, AreRefusedIfTheyAreFewOrOnALineOrInDifferentUnits) {
  const auto refusal = [](const std::vector<TouchedPoint>& points) {
    return test::refusal_of([&] { static_cast<void>(calibrate_camera_by_points(points)); });
  };
  EXPECT_THAT(refusal(touched(2)), AllOf(HasSubstr("2 points"), HasSubstr("3 or more")));
  std::vector<TouchedPoint> line = touched(6);
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i].p_A = Eigen::Vector3d(0.1 * static_cast<double>(i), 0.0, 0.3);
    line[i].p_C = kCamera.inverse() * line[i].p_A;
  }
  EXPECT_THAT(refusal(line), HasSubstr("lie on a line"));
  for (const int count : {4, 8}) {
    std::vector<TouchedPoint> millimetres = touched(count);
    for (TouchedPoint& point : millimetres) {
      point.p_C *= 1000.0;
    }
    EXPECT_THAT(refusal(millimetres), AllOf(HasSubstr("1000 times"), HasSubstr("in metres")));
  }
}

}  // namespace
}  // namespace handway::geometric
