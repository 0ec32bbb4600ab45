#include "handway/device/retargeting/fingertip_retargeter.h"

#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using geometric::kDegree;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::shared_ptr<const geometric::RobotModel> shipped(const std::string& robot) {
  return geometric::load_robot(
      geometric::find_resource(geometric::ResourceKind::kRobot, robot, test::source_dir()));
}

std::shared_ptr<const geometric::RobotModel> sah() { return shipped("sah_right"); }

std::vector<std::string> finger_names(const RobotFingers& hand) {
  std::vector<std::string> names;
  for (const RobotFinger& finger : hand.fingers) {
    names.push_back(name_of(finger.finger));
  }
  return names;
}

std::string tip_of(const geometric::RobotModel& model, const RobotFingers& hand, Finger finger) {
  const auto found = std::ranges::find(hand.fingers, finger, &RobotFinger::finger);
  return found == hand.fingers.end() ? "" : model.link(found->tip_link).name;
}

GloveAngles bent(double fingers, double thumb_roll) {
  GloveAngles angles;
  angles.angles.fill(0.0);
  for (const char* name :
       {"IndexMPJ", "IndexPIJ", "MiddleMPJ", "MiddlePIJ", "RingMPJ", "RingPIJ"}) {
    angles.angles.at(static_cast<std::size_t>(*find_sensor(name))) = fingers;
  }
  angles.angles.at(static_cast<std::size_t>(*find_sensor("ThumbRotate"))) = thumb_roll;
  angles.angles.at(static_cast<std::size_t>(*find_sensor("ThumbAbduct"))) = 0.5 * thumb_roll;
  return angles;
}

/// Mean distance of fingertips from where they are wanted, m.
double mean_miss(const FingertipRetargeter& hand, const HandLandmarks& landmarks,
                 const Eigen::VectorXd& posture) {
  return (hand.fingertips(posture) - hand.wanted(landmarks)).colwise().norm().mean();
}

TEST(RobotFingers, AreFoundOnTheSahHand) {
  const RobotFingers hand = find_fingers(*sah());
  EXPECT_THAT(finger_names(hand), ElementsAre("thumb", "index", "middle", "ring"));
  EXPECT_FALSE(hand.left);
  EXPECT_GT(hand.fingers[0].reach, 0.2) << "the thumb's first joint is at the wrist";
  for (std::size_t f = 1; f < hand.fingers.size(); ++f) {
    EXPECT_NEAR(hand.fingers[f].reach, 0.137, 0.001);
  }
}

TEST(RobotFingers, AreFoundByTheirPlacesWhereNamesSayNothing) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto allegro =
      geometric::load_robot(reference / "robots" / "allegro_hand" / "allegro_hand_right.urdf");
  const RobotFingers hand = find_fingers(*allegro);
  EXPECT_EQ(tip_of(*allegro, hand, Finger::kThumb), "link_15.0_tip");
  EXPECT_EQ(tip_of(*allegro, hand, Finger::kIndex), "link_3.0_tip");
  EXPECT_EQ(tip_of(*allegro, hand, Finger::kMiddle), "link_7.0_tip");
  EXPECT_EQ(tip_of(*allegro, hand, Finger::kRing), "link_11.0_tip");
  EXPECT_FALSE(hand.left);
}

TEST(RobotFingers, AreFoundOnAHandWithAWrist) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto shadow =
      geometric::load_robot(reference / "robots" / "shadow_hand" / "shadow_hand_right.urdf");
  const RobotFingers hand = find_fingers(*shadow);
  EXPECT_THAT(finger_names(hand), ElementsAre("thumb", "index", "middle", "ring", "little"));
  EXPECT_FALSE(hand.left);
  for (const RobotFinger& finger : hand.fingers) {
    for (const int v : finger.variables) {
      EXPECT_EQ(shadow->variable(v).name.find("WRJ"), std::string::npos);
    }
  }
}

TEST(RobotFingers, AreThoseOfALeftHand) {
  const auto right = sah();
  const auto left =
      std::make_shared<const geometric::RobotModel>(geometric::mirrored(right->description()));
  const RobotFingers fingers = find_fingers(*left);
  EXPECT_TRUE(fingers.left);
  EXPECT_THAT(finger_names(fingers), ElementsAre("thumb", "index", "middle", "ring"));
  // It follows the same hand as the right one does, in mirrored postures.
  const FingertipRetargeter right_hand(right);
  const FingertipRetargeter left_hand(left);
  const HandLandmarks landmarks = hand_landmarks(bent(30 * kDegree, 40 * kDegree));
  const Eigen::VectorXd posture = left_hand.posture(landmarks, left_hand.middle());
  EXPECT_LT(mean_miss(left_hand, landmarks, posture), 0.03);
  EXPECT_TRUE(posture.isApprox(right_hand.posture(landmarks, right_hand.middle()), 1e-3));
}

TEST(RobotFingers, AreThoseThatFingertipsName) {
  const auto model = sah();
  const RobotFingers all = find_fingers(*model);
  const std::string thumb = tip_of(*model, all, Finger::kThumb);
  const std::string index = tip_of(*model, all, Finger::kIndex);
  // The fingertips that the file names count, even if the links' names differ.
  const RobotFingers two = find_fingers(*model, {{Finger::kThumb, thumb}, {Finger::kRing, index}});
  EXPECT_THAT(finger_names(two), ElementsAre("thumb", "ring"));
  EXPECT_EQ(tip_of(*model, two, Finger::kRing), index);
  EXPECT_THAT(test::refusal_of([&] {
                static_cast<void>(find_fingers(*model, {{Finger::kThumb, "no_link"}}));
              }),
              AllOf(HasSubstr("thumb"), HasSubstr("\"no_link\""), HasSubstr("sah_right")));
}

TEST(RobotFingers, AreRefusedOfAnArm) {
  const auto arm = shipped("tx90");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(find_fingers(*arm)); }),
              AllOf(HasSubstr("0 fingers"), HasSubstr("two to five")));
}

TEST(FingertipRetargeter, BringsFingertipsWhereThePersonsAre) {
  const FingertipRetargeter hand(sah());
  Eigen::VectorXd posture = hand.middle();
  for (const double flexion : {10.0, 30.0, 50.0}) {
    const HandLandmarks landmarks = hand_landmarks(bent(flexion * kDegree, 40 * kDegree));
    const double before = mean_miss(hand, landmarks, posture);
    posture = hand.posture(landmarks, posture);
    EXPECT_LE(mean_miss(hand, landmarks, posture), before);
    EXPECT_LT(mean_miss(hand, landmarks, posture), 0.03) << flexion;
    EXPECT_TRUE((posture.array() >= hand.lower().array()).all());
    EXPECT_TRUE((posture.array() <= hand.upper().array()).all());
  }
}

TEST(FingertipRetargeter, MovesLessThePricierAMoveIs) {
  RetargetingSettings lazy;
  lazy.smoothness = 100.0;
  const FingertipRetargeter quick(sah());
  const FingertipRetargeter slow(sah(), lazy);
  const HandLandmarks closed = hand_landmarks(bent(60 * kDegree, 60 * kDegree));
  const Eigen::VectorXd start = quick.middle();
  EXPECT_LT((slow.posture(closed, start) - start).norm(),
            0.5 * (quick.posture(closed, start) - start).norm());
}

TEST(FingertipRetargeter, IsNearerToThePersonsFingertipsThanTable1) {
  HANDWAY_NEED_REFERENCE(reference);
  const Recording all = read_recording(reference / "glove" / "grasp-rad-su01.txt");
  Recording few = all;
  constexpr Eigen::Index kStep = 50;
  const Eigen::Index rows = all.values.rows() / kStep;
  few.times.resize(rows);
  few.values.resize(rows, all.values.cols());
  for (Eigen::Index row = 0; row < rows; ++row) {
    few.times[row] = all.times[row * kStep];
    few.values.row(row) = all.values.row(row * kStep);
  }
  const auto model = sah();
  const FingertipRetargeter retargeter(model);
  const HandMapper table1(table1_mapping(), *model);
  const auto miss_of = [&](const PostureSource& source) {
    const MappedPostures mapped = source.map_recording(few);
    double sum = 0.0;
    for (Eigen::Index row = 0; row < rows; ++row) {
      sum += mean_miss(retargeter, hand_landmarks(angles_of_row(few, row)),
                       mapped.postures.row(row).transpose());
    }
    return sum / static_cast<double>(rows);
  };
  EXPECT_LT(miss_of(retargeter), 0.5 * miss_of(table1));
}

TEST(Retargeting, IsReadFromAFile) {
  const test::ScratchFolder folder;
  const auto file = folder.path() / "hand.yaml";
  std::ofstream(file) << "hand: sah_right\nretargeting:\n  scale: 1.1\n  self_collision: false\n"
                         "  fingertips: {thumb: a, index: b}\n";
  EXPECT_TRUE(is_retargeting(file));
  const RetargetingSettings settings = read_retargeting(file);
  EXPECT_EQ(settings.hand, "sah_right");
  EXPECT_EQ(settings.scale, 1.1);
  EXPECT_FALSE(settings.self_collision);
  EXPECT_EQ(settings.fingertips.at(Finger::kIndex), "b");
}

TEST(Retargeting, RefusesAScaleOfNothing) {
  const test::ScratchFolder folder;
  const auto file = folder.path() / "hand.yaml";
  std::ofstream(file) << "hand: sah_right\nretargeting:\n  scale: 0\n";
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_retargeting(file)); }),
              AllOf(HasSubstr("hand.yaml:3"), HasSubstr("scale"), HasSubstr("above 0")));
}

TEST(FingertipRetargeter, ServesSeveralThreadsAtOnce) {
  const FingertipRetargeter hand(sah());
  const auto postures = [&] {
    std::vector<Eigen::VectorXd> result;
    Eigen::VectorXd last = hand.middle();
    for (int i = 0; i < 200; ++i) {
      last = hand.posture(hand_landmarks(bent(0.008 * i, 1.2)), last);
      result.push_back(last);
    }
    return result;
  };
  const std::vector<Eigen::VectorXd> alone = postures();
  auto here = std::async(std::launch::async, postures);
  auto there = std::async(std::launch::async, postures);
  EXPECT_EQ(here.get(), alone);
  EXPECT_EQ(there.get(), alone);
}

}  // namespace
}  // namespace handway::device
