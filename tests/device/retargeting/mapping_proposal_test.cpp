#include "handway/device/retargeting/mapping_proposal.h"

#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/device/retargeting/mapping_fit.h"
#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using geometric::kDegree;
using geometric::RobotModel;
using testing::HasSubstr;

std::shared_ptr<const RobotModel> library_hand(const std::string& robot) {
  return geometric::load_robot(
      geometric::find_resource(geometric::ResourceKind::kRobot, robot, test::source_dir()));
}

const JointMapping& mapping_of(const HandMapping& mapping, const std::string& joint) {
  return *std::ranges::find(mapping.joints, joint, &JointMapping::joint);
}

std::string sensor_of(const HandMapping& mapping, const std::string& joint) {
  const JointMapping& mapped = mapping_of(mapping, joint);
  return mapped.sensor < 0
             ? "fixed"
             : std::string(cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].name);
}

void set(GloveAngles& angles, const std::string& sensor, double degrees) {
  angles.angles.at(static_cast<std::size_t>(find_sensor(sensor).value())) = degrees * kDegree;
}

GloveAngles flat() {
  GloveAngles angles;
  angles.angles.fill(0.0);
  return angles;
}

/// All joints of the fingers bent by so many degrees.
GloveAngles bent_by(double degrees) {
  GloveAngles angles = flat();
  for (const char* finger : {"Index", "Middle", "Ring", "Pinkie"}) {
    for (const char* joint : {"MPJ", "PIJ", "DIJ"}) {
      set(angles, std::string(finger) + joint, degrees);
    }
  }
  return angles;
}

/// Returns the positions of the fingertips of a mapped hand in the frame of a person's palm, from
/// the finger's base, in lengths of the finger.
std::vector<Eigen::Vector3d> mapped_tips(const RobotModel& model, const HandMapping& mapping,
                                         const GloveAngles& angles) {
  const RobotFingers hand = find_fingers(model);
  const HandMapper mapper(mapping, model);
  const Eigen::VectorXd posture = mapper.posture(angles);
  geometric::Configuration q = model.neutral();
  for (std::size_t j = 0; j < mapper.joints().size(); ++j) {
    q[model.find_variable(mapper.joints()[j]).value()] = posture[static_cast<Eigen::Index>(j)];
  }
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  std::vector<Eigen::Vector3d> tips;
  for (const RobotFinger& finger : hand.fingers) {
    const Eigen::Vector3d p_P = X_BL[static_cast<std::size_t>(hand.palm)].inverse() *
                                (X_BL[static_cast<std::size_t>(finger.tip_link)] * finger.p_LT);
    Eigen::Vector3d p_H = hand.R_PH.transpose() * (p_P - finger.p_PB) / finger.reach;
    p_H.z() *= hand.left ? -1.0 : 1.0;
    tips.push_back(p_H);
  }
  return tips;
}

/// Checks the properties of a proposed mapping on any hand.
void expect_moves_like_a_person(const RobotModel& model) {
  const HandMapping mapping = propose_mapping(model);
  const auto straight = mapped_tips(model, mapping, flat());
  const auto closed = mapped_tips(model, mapping, bent_by(60.0));
  const auto half_closed = mapped_tips(model, mapping, bent_by(30.0));
  GloveAngles to_thumb = bent_by(30.0);
  set(to_thumb, "MiddleIndexAbduct", 15.0);
  set(to_thumb, "RingMiddleAbduct", -15.0);
  const auto spread = mapped_tips(model, mapping, to_thumb);
  GloveAngles beside = flat();
  set(beside, "ThumbAbduct", 40.0);
  set(beside, "ThumbMPJ", 20.0);
  GloveAngles opposed = beside;
  set(opposed, "ThumbRotate", 70.0);
  // The axis turns the thumb from beside the palm (y) to before it (-z), as a person's.
  const Eigen::Vector3d across(0.0, 1.0, 1.0);
  const double thumb_beside = mapped_tips(model, mapping, beside)[0].dot(across);
  const double thumb_opposed = mapped_tips(model, mapping, opposed)[0].dot(across);
  for (std::size_t f = 1; f < straight.size(); ++f) {
    EXPECT_GT(straight[f].x(), 0.9) << "finger " << f << " is straight";
    EXPECT_LT(closed[f].norm(), 0.8) << "finger " << f << " is bent";
    EXPECT_LT(closed[f].z(), straight[f].z() - 0.2) << "finger " << f << " bends to the palm";
  }
  EXPECT_GT(spread[1].y(), half_closed[1].y() + 0.02)
      << "the index finger goes to the thumb's side";
  EXPECT_GT(spread[3].y(), half_closed[3].y() + 0.02) << "the ring finger, too";
  EXPECT_LT(thumb_opposed, thumb_beside - 0.05) << "the thumb opposes the palm";
}

TEST(ProposedMapping, IsThatOfThePaperOnTheSahHand) {
  const auto hand = library_hand("sah_right");
  const HandMapping proposed = propose_mapping(*hand);
  EXPECT_EQ(proposed.hand, "sah_right");
  for (const JointMapping& mapped : table1_mapping().joints) {
    if (mapped.joint == "thumb_abduction") {  // the paper lets roll drive it, too
      EXPECT_EQ(sensor_of(proposed, mapped.joint), "ThumbAbduct");
      continue;
    }
    const JointMapping& own = mapping_of(proposed, mapped.joint);
    EXPECT_EQ(own.sensor, mapped.sensor) << mapped.joint;
    EXPECT_EQ(own.gain > 0.0, mapped.gain > 0.0) << mapped.joint;
  }
  expect_moves_like_a_person(*hand);
}

TEST(ProposedMapping, LeavesTheArmOfAnArmWithAHandOut) {
  const auto robot = library_hand("tx90_sah");
  const HandMapping mapping = propose_mapping(*robot);
  EXPECT_EQ(mapping.joints.size(), 13U);
  expect_moves_like_a_person(*robot);
}

TEST(ProposedMapping, MovesHandsWhoseNamesSayNothing) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto allegro =
      geometric::load_robot(reference / "robots" / "allegro_hand" / "allegro_hand_right.urdf");
  const HandMapping mapping = propose_mapping(*allegro);
  EXPECT_EQ(sensor_of(mapping, "joint_1.0"), "IndexMPJ");
  EXPECT_EQ(sensor_of(mapping, "joint_3.0"), "IndexDIJ");
  EXPECT_EQ(sensor_of(mapping, "joint_4.0"), "fixed");
  EXPECT_EQ(sensor_of(mapping, "joint_8.0"), "RingMiddleAbduct");
  EXPECT_EQ(sensor_of(mapping, "joint_12.0"), "ThumbRotate");
  EXPECT_EQ(sensor_of(mapping, "joint_15.0"), "ThumbIJ");
  expect_moves_like_a_person(*allegro);
}

/// Returns a hand whose ring and little finger are on a part of the palm that moves with the
/// thumb's base, and whose thumb has two joints. @param thumb_base axis of the first.
RobotModel folding_hand(const Eigen::Vector3d& thumb_base = Eigen::Vector3d::UnitZ()) {
  geometric::RobotDescription robot;
  robot.links.push_back({"palm", {}, {}});
  const auto add = [&](const std::string& parent, const std::string& child,
                       const Eigen::Vector3d& p, const Eigen::Vector3d& axis) {
    robot.links.push_back({child, {}, {}});
    geometric::Joint& joint = robot.joints.emplace_back();
    joint.name = child + "_joint";
    joint.type = geometric::JointType::kRevolute;
    joint.parent = parent;
    joint.child = child;
    joint.axis = axis;
    joint.X_PJ.translation() = p;
    joint.limits = {0.0, 1.5, 1.0};
  };
  const auto add_finger = [&](const std::string& parent, const std::string& name, double y) {
    add(parent, name, {0.0, y, 0.1}, Eigen::Vector3d::UnitY());
    add(name, name + "_outer", {0.0, 0.0, 0.04}, Eigen::Vector3d::UnitY());
  };
  add("palm", "thumb", {0.02, 0.04, 0.03}, thumb_base);
  add("thumb", "thumb_outer", {0.04, 0.0, 0.02}, Eigen::Vector3d::UnitX());
  add("palm", "fold", {0.0, -0.01, 0.03}, Eigen::Vector3d::UnitZ());
  robot.joints.back().mimic = geometric::Mimic{"thumb_joint", 1.0, 0.0};
  add_finger("palm", "index", 0.03);
  add_finger("palm", "middle", 0.01);
  add_finger("fold", "ring", 0.0);
  add_finger("fold", "little", -0.02);
  return RobotModel(robot);
}

TEST(ProposedMapping, MovesFingersOnAPartOfThePalmThatMoves) {
  const HandMapping mapping = propose_mapping(folding_hand());
  EXPECT_EQ(mapping.joints.size(), 10U);
  EXPECT_EQ(sensor_of(mapping, "ring_outer_joint"), "RingPIJ");
  EXPECT_EQ(sensor_of(mapping, "little_outer_joint"), "PinkiePIJ");
  EXPECT_EQ(sensor_of(mapping, "thumb_joint"), "ThumbRotate") << "not the ring's";
}

TEST(ProposedMapping, TellsAThumbThatOpposesFromOneThatBendsTwiceByTheAxisOfItsFirstJoint) {
  const HandMapping bends = propose_mapping(folding_hand(Eigen::Vector3d::UnitX()));
  EXPECT_EQ(sensor_of(bends, "thumb_joint"), "ThumbMPJ");
  const HandMapping opposes =
      propose_mapping(folding_hand(Eigen::Vector3d(0.2, 0.3, 1.0).normalized()));
  EXPECT_EQ(sensor_of(opposes, "thumb_joint"), "ThumbRotate");
  EXPECT_EQ(sensor_of(opposes, "thumb_outer_joint"), "ThumbIJ");
}

TEST(ProposedMapping, KnowsPalmAndWristOfAHandWithBoth) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto shadow =
      geometric::load_robot(reference / "robots" / "shadow_hand" / "shadow_hand_right.urdf");
  const HandMapping mapping = propose_mapping(*shadow);
  EXPECT_EQ(sensor_of(mapping, "WRJ1"), "WristPitch");
  EXPECT_EQ(sensor_of(mapping, "WRJ2"), "WristYaw");
  EXPECT_EQ(sensor_of(mapping, "LFJ5"), "PalmArch");
  EXPECT_EQ(sensor_of(mapping, "LFJ4"), "PinkieRingAbduct");
  EXPECT_EQ(sensor_of(mapping, "THJ5"), "ThumbRotate");
  EXPECT_EQ(sensor_of(mapping, "THJ3"), "fixed");
  expect_moves_like_a_person(*shadow);
}

TEST(ProposedMapping, RefusesARobotWithoutFingers) {
  EXPECT_THROW((void)propose_mapping(*library_hand("tx90")), geometric::InputError);
}

/// Open, fist and open again of an index finger that bends as far as `most`, and a middle and ring
/// finger that bend by 80°; degrees.
Recording open_and_fist(double index_most) {
  constexpr Eigen::Index kRows = 101;
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  for (const char* name :
       {"IndexMPJ", "MiddleMPJ", "RingMPJ", "PinkieMPJ", "MiddleIndexAbduct", "ThumbRotate"}) {
    recording.header.sensors.push_back(find_sensor(name).value());
  }
  recording.times = Eigen::VectorXd::LinSpaced(kRows, 0.0, 1.0);
  recording.values.resize(kRows, 6);
  for (Eigen::Index row = 0; row < kRows; ++row) {
    const double closed = std::sin(M_PI * recording.times[row]);
    recording.values.row(row) << index_most * closed, 80.0 * closed, 80.0 * closed, 80.0 * closed,
        10.0 * std::cos(2.0 * M_PI * recording.times[row]), 50.0 * closed;
  }
  recording.values *= kDegree;
  return recording;
}

/// Mean distance of the fingertips from the person's, mm.
double mean_error(const HandMapping& mapping, const std::shared_ptr<const RobotModel>& hand,
                  const Recording& recording) {
  RetargetingSettings only_kinematics;
  only_kinematics.self_collision = false;
  std::vector<GloveAngles> rows;
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    rows.push_back(angles_of_row(recording, row));
  }
  const HandMapper mapper(mapping, *hand);
  return 1e3 * fingertip_errors(rows, mapper.joints(), mapper.map_recording(recording).postures,
                                FingertipRetargeter(hand, only_kinematics))
                   .mean;
}

TEST(FittedMapping, TakesWiresOfTooSmallAGainToWhereThePersonsFingertipsAre) {
  const auto hand = library_hand("sah_right");
  const Recording motion = open_and_fist(80.0);
  HandMapping lazy = propose_mapping(*hand);
  for (JointMapping& mapped : lazy.joints) {
    mapped.gain *= 0.2;
  }
  const MappingFit fit = fit_mapping(lazy, *hand, motion);
  EXPECT_GT(std::abs(mapping_of(fit.mapping, "index_proximal").gain),
            2.0 * std::abs(mapping_of(lazy, "index_proximal").gain));
  EXPECT_THAT(fit.warnings, testing::Contains(HasSubstr("IndexPIJ was not recorded")));
}

/// A hand and a recording, by their files.
struct FitCase {
  std::string hand;
  std::string recording;
};

class FittedMappings : public testing::TestWithParam<FitCase> {};

TEST_P(FittedMappings, NeverTakeFingertipsFartherFromThePersons) {
  HANDWAY_NEED_REFERENCE(reference);
  const std::string& name = GetParam().hand;
  const auto hand = name.ends_with(".urdf") ? geometric::load_robot(reference / "robots" / name)
                                            : library_hand(name);
  const Recording recording = read_recording(reference / "glove" / GetParam().recording);
  const HandMapping proposed = propose_mapping(*hand);
  const MappingFit fit = fit_mapping(proposed, *hand, recording);
  const double before = mean_error(proposed, hand, recording);
  const double after = mean_error(fit.mapping, hand, recording);
  std::cout << name << ", " << GetParam().recording << ": " << before << " mm, fitted " << after
            << " mm\n";
  EXPECT_LE(after, before + 1e-9);
}

std::vector<FitCase> fit_cases() {
  std::vector<FitCase> cases;
  for (const char* hand :
       {"sah_right", "allegro_class_right", "leap_class_right", "shadow_class_right",
        "allegro_hand/allegro_hand_right.urdf", "shadow_hand/shadow_hand_right.urdf"}) {
    for (const char* recording : {"grasp-rad-su01.txt", "calib-rad-su01.txt"}) {
      cases.push_back({hand, recording});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(AllHands, FittedMappings, testing::ValuesIn(fit_cases()));

TEST(FittedMapping, TurnsASensorThatFallsWhileTheOtherFingersBend) {
  const auto hand = library_hand("sah_right");
  const MappingFit fit = fit_mapping(propose_mapping(*hand), *hand, open_and_fist(-60.0));
  EXPECT_GT(mapping_of(fit.mapping, "index_proximal").gain, 0.0);
  EXPECT_LT(mapping_of(fit.mapping, "middle_proximal").gain, 0.0);
  EXPECT_THAT(fit.warnings, testing::Contains(HasSubstr("IndexMPJ is reversed")));
}

TEST(FittedMapping, KeepsTheWireOfASensorThatHardlyMoved) {
  const auto hand = library_hand("sah_right");
  const HandMapping proposed = propose_mapping(*hand);
  const MappingFit fit = fit_mapping(proposed, *hand, open_and_fist(2.0));
  EXPECT_EQ(mapping_of(fit.mapping, "index_proximal").gain,
            mapping_of(proposed, "index_proximal").gain);
  EXPECT_THAT(fit.warnings, testing::Contains(HasSubstr("IndexMPJ hardly moved")));
}

}  // namespace
}  // namespace handway::device
