#include "handway/device/glove/mano_hand.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

namespace handway::device {
namespace {

// Joints in the model's order.
constexpr int kIndexKnuckle = 0;
constexpr int kIndexMiddle = 1;
constexpr int kIndexOuter = 2;
constexpr int kThumbOuter = 14;

double angle_of(const ManoPose& pose, std::string_view sensor, bool left = false) {
  const HandLandmarks points = mano_landmarks(pose, usual_mano_joints(left));
  return glove_angles(in_palm_frame(points, left))
      .angles.at(static_cast<std::size_t>(find_sensor(sensor).value()));
}

ManoPose with(int joint, const Eigen::Vector3d& rotation) {
  ManoPose pose = ManoPose::Zero();
  pose.col(joint) = rotation;
  return pose;
}

TEST(ManoHand, HasTypicalBonesAtRestAndInAnyPosture) {
  const HandBones typical = typical_bones();
  for (const bool left : {false, true}) {
    for (const ManoPose& pose : {ManoPose(ManoPose::Zero()), ManoPose(ManoPose::Constant(0.4))}) {
      const HandBones bones = bones_of(mano_landmarks(pose, usual_mano_joints(left)));
      for (std::size_t finger = 0; finger < bones.size(); ++finger) {
        for (std::size_t bone = 0; bone < bones[finger].size(); ++bone) {
          EXPECT_NEAR(bones[finger].at(bone), typical[finger].at(bone), 1e-12)
              << finger << " " << bone;
        }
      }
    }
  }
}

TEST(ManoHand, PointsAlongTheAxesOfTheModel) {
  for (const bool left : {false, true}) {
    const HandLandmarks points = mano_landmarks(ManoPose::Zero(), usual_mano_joints(left));
    const double side = left ? 1.0 : -1.0;
    EXPECT_GT(side * points(0, tip_landmark(Finger::kMiddle)), 0.15);
    EXPECT_GT(points(2, tip_landmark(Finger::kThumb)), 0.05);
    EXPECT_LT(points(2, tip_landmark(Finger::kLittle)), -0.05);
    const Eigen::Vector3d back = palm_frame(points).linear().col(2);
    EXPECT_GT((left ? -1.0 : 1.0) * back.y(), 0.9) << "y is out of the back of the hand";
  }
}

TEST(ManoHand, BendsTheJointOfEachRotation) {
  const ManoPose flat = ManoPose::Zero();
  // Fingers are fanned out at rest: each bends about an axis across it.
  const struct {
    int joint;
    const char* sensor;
    double fan;  // degrees
  } cases[] = {{0, "IndexMPJ", 4.0},    {1, "IndexPIJ", 0.0},    {2, "IndexDIJ", 0.0},
               {3, "MiddleMPJ", -10.0}, {4, "MiddlePIJ", -10.0}, {5, "MiddleDIJ", -10.0},
               {7, "PinkiePIJ", -33.0}, {9, "RingMPJ", -10.0},   {10, "RingPIJ", -18.0},
               {11, "RingDIJ", -18.0}};
  for (const auto& [joint, sensor, fan] : cases) {
    const double turn = geometric::radians(fan);
    const Eigen::Vector3d across(std::sin(turn), 0.0, std::cos(turn));
    for (const double angle : {0.3, 1.0}) {
      EXPECT_NEAR(angle_of(with(joint, angle * across), sensor) - angle_of(flat, sensor), angle,
                  0.03)
          << sensor;
    }
  }
}

TEST(ManoHand, SpreadsFingersAboutTheBackOfTheHand) {
  const double before = angle_of(ManoPose::Zero(), "MiddleIndexAbduct");
  const double after =
      angle_of(with(kIndexKnuckle, 0.2 * Eigen::Vector3d::UnitY()), "MiddleIndexAbduct");
  EXPECT_NEAR(after - before, 0.2, 0.01) << "towards the thumb";
}

TEST(ManoHand, RotatesWhatFollowsAJoint) {
  const ManoJoints rest = usual_mano_joints(false);
  const HandLandmarks flat = mano_landmarks(ManoPose::Zero(), rest);
  const double angle = 0.7;
  const HandLandmarks bent =
      mano_landmarks(with(kIndexMiddle, angle * Eigen::Vector3d::UnitZ()), rest);
  const int knuckle = base_landmark(Finger::kIndex);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int landmark = 0; landmark < 21; ++landmark) {
    const bool follows = landmark > knuckle + 1 && landmark <= knuckle + 3;
    const Eigen::Vector3d expected =
        follows ? Eigen::Vector3d(flat.col(knuckle + 1) +
                                  R * (flat.col(landmark) - flat.col(knuckle + 1)))
                : Eigen::Vector3d(flat.col(landmark));
    EXPECT_LT((bent.col(landmark) - expected).norm(), 1e-12) << landmark;
  }
}

TEST(ManoHand, ComposesRotationsFromThePalmOutwards) {
  ManoPose pose = with(kIndexKnuckle, {0.0, 0.3, 0.4});
  pose.col(kIndexOuter) = Eigen::Vector3d(0.0, 0.0, 0.9);
  const ManoJoints rest = usual_mano_joints(false);
  const HandLandmarks points = mano_landmarks(pose, rest);
  const auto rotation = [](const Eigen::Vector3d& vector) {
    return Eigen::AngleAxisd(vector.norm(), vector.normalized()).toRotationMatrix();
  };
  const Eigen::Matrix3d R = rotation(pose.col(kIndexKnuckle)) * rotation(pose.col(kIndexOuter));
  const int tip = tip_landmark(Finger::kIndex);
  const Eigen::Vector3d outer = (points.col(tip) - points.col(tip - 1)).normalized();
  EXPECT_LT((outer - R * (rest.col(3) - rest.col(2)).normalized()).norm(), 1e-12);
}

TEST(ManoHand, MeasuresAMirroredLeftHandLikeARightOne) {
  ManoPose right;
  for (int joint = 0; joint < kManoJoints; ++joint) {
    right.col(joint) = Eigen::Vector3d(0.02 * joint, 0.1 - 0.01 * joint, 0.3 + 0.03 * joint);
  }
  ManoPose left = right;
  left.bottomRows<2>() *= -1.0;  // rotations in a mirror
  for (const int sensor : landmark_sensors()) {
    const std::string_view name = cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
    EXPECT_NEAR(angle_of(left, name, true), angle_of(right, name), 1e-12) << name;
  }
}

TEST(ManoHand, TakesOtherJointsAtRest) {
  const ManoJoints small = 0.8 * usual_mano_joints(false);
  const HandBones bones = bones_of(mano_landmarks(with(kThumbOuter, {0.1, 0.2, 0.3}), small));
  EXPECT_NEAR(bones[1][1], 0.8 * typical_bones()[1][1], 1e-12);
  EXPECT_NEAR(bones[0][3], 0.8 * typical_bones()[0][3], 1e-12);
}

}  // namespace
}  // namespace handway::device
