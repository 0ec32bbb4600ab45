#include "handway/device/glove/human_hand.h"

#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace handway::device {
namespace {

using geometric::kDegree;

GloveAngles flat() {
  GloveAngles angles;
  angles.angles.fill(0.0);
  return angles;
}

double& sensor(GloveAngles& angles, const char* name) {
  return angles.angles.at(static_cast<std::size_t>(*find_sensor(name)));
}

GloveAngles half_closed() {
  GloveAngles angles = flat();
  sensor(angles, "ThumbRotate") = 50 * kDegree;
  sensor(angles, "ThumbAbduct") = 35 * kDegree;
  sensor(angles, "ThumbMPJ") = 20 * kDegree;
  sensor(angles, "ThumbIJ") = 30 * kDegree;
  sensor(angles, "IndexMPJ") = 40 * kDegree;
  sensor(angles, "IndexPIJ") = 60 * kDegree;
  sensor(angles, "IndexDIJ") = 25 * kDegree;
  sensor(angles, "RingMPJ") = 55 * kDegree;
  sensor(angles, "MiddleIndexAbduct") = 10 * kDegree;
  sensor(angles, "RingMiddleAbduct") = 6 * kDegree;
  sensor(angles, "PinkieRingAbduct") = 8 * kDegree;
  return angles;
}

HandLandmarks seen_from_a_camera(const HandLandmarks& landmarks) {
  const geometric::Pose camera = geometric::pose_from_rpy({0.3, -0.2, 0.6}, 0.4, -1.1, 2.0);
  return (camera.linear() * landmarks).colwise() + camera.translation();
}

TEST(HumanHand, IsAsLongAsItIsToBe) {
  const HandLandmarks hand = hand_landmarks(flat(), typical_bones(0.2));
  const double length = hand.col(tip_landmark(Finger::kMiddle)).norm();
  EXPECT_NEAR(length, 0.2, 0.003);
}

TEST(HumanHand, ClosesTowardsThePalmAndOpposesTheThumb) {
  const HandLandmarks open = hand_landmarks(flat());
  const HandLandmarks closed = hand_landmarks(half_closed());
  EXPECT_LT(closed(2, tip_landmark(Finger::kIndex)), open(2, tip_landmark(Finger::kIndex)) - 0.05);
  EXPECT_LT(closed(2, tip_landmark(Finger::kThumb)), open(2, tip_landmark(Finger::kThumb)) - 0.02);
  EXPECT_GT(closed(1, tip_landmark(Finger::kThumb)), 0.0) << "the thumb is on its own side";
}

TEST(HumanHand, GivesItsAnglesBackFromLandmarksOfAnySize) {
  const GloveAngles angles = half_closed();
  for (const double length : {0.16, 0.21}) {
    const GloveAngles found = glove_angles(
        in_palm_frame(seen_from_a_camera(hand_landmarks(angles, typical_bones(length))), false));
    for (int i = 0; i < kGloveSensors; ++i) {
      const auto place = static_cast<std::size_t>(i);
      if (std::ranges::count(landmark_sensors(), i) > 0) {
        EXPECT_NEAR(found.angles.at(place), angles.angles.at(place), 1e-9)
            << cyberglove_sensors()[place].name;
      } else {
        EXPECT_TRUE(std::isnan(found.angles.at(place)));
      }
    }
  }
}

TEST(HumanHand, HasTheBonesThatLandmarksShow) {
  HandBones own = typical_bones(0.18);
  own[0] = {0.03, 0.05, 0.04, 0.02};
  own[3][2] = 0.041;
  const HandBones found = bones_of(seen_from_a_camera(hand_landmarks(half_closed(), own)));
  HandBones blurred = own;
  blurred[3][2] = 0.2;
  const std::vector<HandBones> frames{found, blurred, found};
  const HandBones median = median_bones(frames);
  for (std::size_t f = 0; f < own.size(); ++f) {
    for (std::size_t i = 0; i < own[f].size(); ++i) {
      EXPECT_NEAR(median.at(f).at(i), own.at(f).at(i), 1e-9) << f << ", " << i;
    }
  }
}

TEST(HumanHand, MirrorsALeftOne) {
  HandLandmarks left = hand_landmarks(half_closed());
  left.row(1) *= -1.0;
  const HandLandmarks right = in_palm_frame(seen_from_a_camera(left), true);
  EXPECT_TRUE(right.isApprox(hand_landmarks(half_closed()), 1e-9));
}

TEST(HumanHand, RefusesLandmarksInALine) {
  HandLandmarks line = HandLandmarks::Zero();
  line.row(0).setLinSpaced(0.0, 0.2);
  EXPECT_THROW(static_cast<void>(in_palm_frame(line, false)), std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
