// Tests hands as other makers describe them: built otherwise, with other signs, zeros, frames and
// names.

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/device/retargeting/mapping_check.h"
#include "handway/device/retargeting/mapping_proposal.h"
#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway_test/paths.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::JointType;
using geometric::kDegree;
using geometric::RobotDescription;
using geometric::RobotModel;
using testing::HasSubstr;
using testing::IsEmpty;

/// Describes a hand link by link; each link is a slender box along z.
class HandBuilder {
 public:
  explicit HandBuilder(const std::string& name) {
    robot_.name = name;
    robot_.links.push_back({"palm", {}, {box({0.02, 0.07, 0.07}, {0.0, 0.0, 0.045})}});
  }

  geometric::Joint& add(const std::string& parent, const std::string& child, const Vector3d& place,
                        const Vector3d& axis, double lower, double upper, double length = 0.02) {
    robot_.links.push_back(
        {child, {}, {box({0.006, 0.006, 0.8 * length}, {0.0, 0.0, 0.5 * length})}});
    geometric::Joint& joint = robot_.joints.emplace_back();
    joint.name = child + "_joint";
    joint.type = JointType::kRevolute;
    joint.parent = parent;
    joint.child = child;
    joint.axis = axis.normalized();
    joint.X_PJ.translation() = place;
    joint.limits = {lower, upper, 2.0};
    return joint;
  }

  [[nodiscard]] const RobotDescription& description() const { return robot_; }
  [[nodiscard]] std::shared_ptr<const RobotModel> model() const {
    return std::make_shared<const RobotModel>(robot_);
  }

 private:
  static geometric::LinkGeometry box(const Vector3d& size, const Vector3d& centre) {
    geometric::LinkGeometry geometry;
    geometry.shape = geometric::Box{size};
    geometry.X_LG.translation() = centre;
    return geometry;
  }

  RobotDescription robot_;
};

constexpr double kFingerSpacing = 0.022;

/// A hand of five fingers whose palm faces x: they yaw about the back of the knuckles and bend
/// about axes that are `before` it, to one side only.
/// @param side 1: the thumb is at negative y, as of a left hand; -1: a right hand.
HandBuilder offset_hand(double before, double side, double most) {
  HandBuilder hand("offset_hand");
  double y = -0.018;
  for (const char* name : {"index", "middle", "ring", "pinky"}) {
    const std::string finger = name;
    hand.add("palm", finger + "_yaw", {-0.006, side * y, 0.085}, Vector3d::UnitX(), -0.35, 0.35,
             0.004);
    hand.add(finger + "_yaw", finger + "_inner", {before, 0.0, 0.004}, Vector3d::UnitY(), 0.0, most,
             0.045);
    hand.add(finger + "_inner", finger + "_middle", {0.0, 0.0, 0.045}, Vector3d::UnitY(), 0.0, most,
             0.03);
    hand.add(finger + "_middle", finger + "_outer", {0.0, 0.0, 0.03}, Vector3d::UnitY(), 0.0, most,
             0.028);
    y += kFingerSpacing;
  }
  const Vector3d bends(-0.87 * side, -0.5, 0.0);
  hand.add("palm", "thumb_roll", {0.028, -0.01 * side, 0.01}, {-0.35 * side, 0.61, 0.71 * side},
           0.0, 0.87, 0.01);
  hand.add("thumb_roll", "thumb_inner", {0.0, -0.016 * side, 0.0}, bends, 0.0, most, 0.02);
  hand.add("thumb_inner", "thumb_middle", {0.024, -0.038 * side, 0.04}, bends, 0.0, most, 0.02);
  hand.add("thumb_middle", "thumb_outer", {0.015, -0.026 * side, 0.027}, bends, 0.0, most, 0.02);
  return hand;
}

/// A hand of six drives, whose outer joints follow, with joints at the tips that leave no room.
std::shared_ptr<const RobotModel> six_drives(JointType of_tips) {
  HandBuilder hand("six_drives");
  const auto end = [&](const std::string& parent, const Vector3d& place) {
    hand.add(parent, parent + "_end", place, Vector3d::UnitX(), 0.0, 0.0).type = of_tips;
  };
  double y = 0.03;
  for (const char* name : {"index", "middle", "ring", "pinky"}) {
    const std::string finger = name;
    hand.add("palm", finger, {0.0, y, 0.095}, Vector3d::UnitY(), 0.0, 1.57, 0.036);
    hand.add(finger, finger + "_outer", {0.0, 0.0, 0.036}, Vector3d::UnitY(), 0.0, 1.66).mimic =
        geometric::Mimic{finger + "_joint", 1.05, 0.0};
    end(finger + "_outer", {0.0, 0.0, 0.032});
    y -= 0.02;
  }
  hand.add("palm", "thumb", {0.015, 0.03, 0.03}, Vector3d::UnitZ(), 0.0, 2.3);
  hand.add("thumb", "thumb_inner", {0.0, 0.012, 0.012}, Vector3d::UnitX(), 0.0, 0.7);
  hand.add("thumb_inner", "thumb_outer", {0.0, 0.02, 0.03}, Vector3d::UnitX(), 0.0, 1.17).mimic =
      geometric::Mimic{"thumb_inner_joint", 1.67, 0.0};
  end("thumb_outer", {0.0, 0.01, 0.025});
  return hand.model();
}

bool is_flexion(const JointMapping& mapped) {
  if (mapped.sensor < 0) {
    return false;
  }
  const std::string name(cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].name);
  return name.ends_with("MPJ") || name.ends_with("IJ");
}

GloveAngles closed(double degrees) {
  GloveAngles angles;
  angles.angles.fill(0.0);
  for (const char* finger : {"Index", "Middle", "Ring", "Pinkie"}) {
    for (const char* joint : {"MPJ", "PIJ", "DIJ"}) {
      angles.angles.at(static_cast<std::size_t>(*find_sensor(std::string(finger) + joint))) =
          degrees * kDegree;
    }
  }
  return angles;
}

TEST(HandsOfOtherMakers, BendToTheThumbWhereverTheirKnucklesHaveTheirAxes) {
  for (const double before : {0.0, 0.003, 0.011, 0.02}) {
    for (const double most : {45.0 * kDegree, 90.0 * kDegree}) {
      for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(std::to_string(before) + ", " + std::to_string(side));
        const auto model = offset_hand(before, side, most).model();
        const RobotFingers fingers = find_fingers(*model);
        EXPECT_EQ(fingers.left, side > 0.0);
        EXPECT_GT(fingers.R_PH.col(0).z(), 0.95) << "straight fingers point along z";
        const HandMapping mapping = propose_mapping(*model);
        for (const JointMapping& mapped : mapping.joints) {
          EXPECT_TRUE(!is_flexion(mapped) || mapped.gain == 1.0) << mapped.joint;
          EXPECT_TRUE(!is_flexion(mapped) || mapped.offset == 0.0) << mapped.joint;
        }
        EXPECT_THAT(mapping_doubts(mapping, *model), IsEmpty());
      }
    }
  }
}

TEST(HandsOfOtherMakers, TakeJointsWithoutRoomForFixedOnes) {
  const auto no_room = six_drives(JointType::kRevolute);
  const HandMapping mapping = propose_mapping(*no_room);
  const HandMapping fixed = propose_mapping(*six_drives(JointType::kFixed));
  ASSERT_EQ(mapping.joints.size(), 6U);
  ASSERT_EQ(fixed.joints.size(), 6U);
  for (std::size_t w = 0; w < mapping.joints.size(); ++w) {
    EXPECT_EQ(mapping.joints[w].joint, fixed.joints[w].joint);
    EXPECT_EQ(mapping.joints[w].sensor, fixed.joints[w].sensor) << mapping.joints[w].joint;
    EXPECT_NEAR(mapping.joints[w].gain, fixed.joints[w].gain, 1e-12) << mapping.joints[w].joint;
    EXPECT_NEAR(mapping.joints[w].offset, fixed.joints[w].offset, 1e-12) << mapping.joints[w].joint;
  }
  const HandMapper mapper(mapping, *no_room, true);
  const Eigen::VectorXd open = mapper.posture(closed(0.0));
  for (std::size_t j = 0; j < mapper.joints().size(); ++j) {
    if (!mapper.joints()[j].starts_with("thumb")) {
      EXPECT_EQ(open[static_cast<Eigen::Index>(j)], 0.0) << mapper.joints()[j];
    }
  }
  for (const JointMapping& mapped : mapping.joints) {
    EXPECT_TRUE(!is_flexion(mapped) || mapped.gain > 0.0) << mapped.joint;
  }
}

/// `robot` with the signs of its joints turned: each posture is that of negative values.
/// @param every this one of so many.
RobotDescription turned(RobotDescription robot, int every, std::map<std::string, double>& signs) {
  int count = 0;
  for (geometric::Joint& joint : robot.joints) {
    signs[joint.name] = count++ % every == 0 ? -1.0 : 1.0;
  }
  for (geometric::Joint& joint : robot.joints) {
    const double sign = signs[joint.name];
    if (sign < 0.0) {
      joint.axis = -joint.axis;
      std::swap(joint.limits.lower, joint.limits.upper);
      joint.limits.lower *= -1.0;
      joint.limits.upper *= -1.0;
    }
    if (joint.mimic) {
      joint.mimic->multiplier *= sign * signs[joint.mimic->joint];
      joint.mimic->offset *= sign;
    }
  }
  return robot;
}

/// `robot` with its root turned in space.
RobotDescription in_another_frame(RobotDescription robot) {
  const geometric::Pose X(Eigen::AngleAxisd(2.0, Vector3d(0.3, -0.8, 0.5).normalized()) *
                          Eigen::Translation3d(0.01, 0.005, -0.02));
  const std::string root = robot.links.front().name;
  for (auto* shapes : {&robot.links.front().visual, &robot.links.front().collision}) {
    for (geometric::LinkGeometry& shape : *shapes) {
      shape.X_LG = X * shape.X_LG;
    }
  }
  for (geometric::Joint& joint : robot.joints) {
    joint.X_PJ = joint.parent == root ? X * joint.X_PJ : joint.X_PJ;
  }
  return robot;
}

/// Bent by `angle` where all joints of fingers were straight, as of a zero that was chosen
/// elsewhere.
RobotDescription with_other_zeros(RobotDescription robot, double angle) {
  for (geometric::Joint& joint : robot.joints) {
    if (joint.type == JointType::kRevolute && !joint.mimic) {
      joint.X_PJ = joint.X_PJ * Eigen::AngleAxisd(-angle, joint.axis);
      joint.limits.lower += angle;
      joint.limits.upper += angle;
    }
  }
  for (geometric::Joint& joint : robot.joints) {
    if (joint.mimic) {
      joint.mimic->offset -= joint.mimic->multiplier * angle;
    }
  }
  return robot;
}

void expect_same_but_for_signs(const HandMapping& other, const HandMapping& mapping,
                               const std::map<std::string, double>& signs) {
  ASSERT_EQ(other.joints.size(), mapping.joints.size());
  for (const JointMapping& mapped : mapping.joints) {
    const auto found = std::ranges::find(other.joints, mapped.joint, &JointMapping::joint);
    ASSERT_NE(found, other.joints.end()) << mapped.joint;
    const double sign = signs.empty() ? 1.0 : signs.at(mapped.joint);
    EXPECT_EQ(found->sensor, mapped.sensor) << mapped.joint;
    if (mapped.sensor < 0) {
      EXPECT_NEAR(found->fixed.value(), sign * mapped.fixed.value(), 1e-6) << mapped.joint;
      continue;
    }
    EXPECT_NEAR(found->gain, sign * mapped.gain, 1e-6) << mapped.joint;
    EXPECT_NEAR(found->offset, sign * mapped.offset, 1e-6) << mapped.joint;
  }
}

std::vector<std::shared_ptr<const RobotModel>> all_hands() {
  std::vector<std::shared_ptr<const RobotModel>> hands{offset_hand(0.011, 1.0, 0.785).model(),
                                                       offset_hand(0.0, -1.0, 1.57).model(),
                                                       six_drives(JointType::kRevolute)};
  for (const char* name :
       {"sah_right", "allegro_class_right", "leap_class_right", "shadow_class_right"}) {
    hands.push_back(geometric::load_robot(
        geometric::find_resource(geometric::ResourceKind::kRobot, name, test::source_dir())));
  }
  return hands;
}

TEST(HandsOfOtherMakers, HaveTheSameMappingWhateverTheirSignsAndFrames) {
  for (const auto& hand : all_hands()) {
    SCOPED_TRACE(hand->name());
    const HandMapping mapping = propose_mapping(*hand);
    EXPECT_THAT(mapping_doubts(mapping, *hand), IsEmpty());
    for (const int every : {1, 2, 3}) {
      std::map<std::string, double> signs;
      const RobotModel other(turned(hand->description(), every, signs));
      expect_same_but_for_signs(propose_mapping(other), mapping, signs);
      EXPECT_EQ(find_fingers(other).left, find_fingers(*hand).left);
    }
    expect_same_but_for_signs(propose_mapping(RobotModel(in_another_frame(hand->description()))),
                              mapping, {});
    const RobotModel mirrored(geometric::mirrored(hand->description()));
    expect_same_but_for_signs(propose_mapping(mirrored), mapping, {});
    EXPECT_NE(find_fingers(mirrored).left, find_fingers(*hand).left);
  }
}

TEST(HandsOfOtherMakers, AreStraightForAFlatHandWhereverTheirZerosAre) {
  for (const double angle : {-0.5, 0.5}) {
    const auto hand = offset_hand(0.011, -1.0, 1.57);
    const RobotModel other(with_other_zeros(hand.description(), angle));
    const HandMapping mapping = propose_mapping(other);
    const HandMapper mapper(mapping, other, true);
    const Eigen::VectorXd open = mapper.posture(closed(0.0));
    const RobotFingers fingers = find_fingers(other);
    for (const RobotFinger& finger : fingers.fingers) {
      if (finger.finger == Finger::kThumb) {
        continue;
      }
      for (std::size_t k = 1; k < finger.variables.size(); ++k) {  // but for the yaw
        const std::string& joint = other.variable(finger.variables[k]).name;
        const auto j = std::ranges::find(mapper.joints(), joint) - mapper.joints().begin();
        EXPECT_NEAR(open[j], angle, 0.2) << joint;
        EXPECT_GT(finger.flexion[k], 0.0) << joint;
      }
    }
  }
}

/// A hand whose ring and little finger are on a part of the palm that folds with the thumb.
std::shared_ptr<const RobotModel> folding_palm(bool folds) {
  HandBuilder hand("folding_palm");
  const auto add_finger = [&](const std::string& parent, const std::string& name,
                              const Vector3d& place) {
    hand.add(parent, name + "_yaw", place, -Vector3d::UnitX(), -0.2, 0.2, 0.005);
    hand.add(name + "_yaw", name + "_inner", {0.0, 0.0, 0.005}, Vector3d::UnitY(), 0.0, 1.3, 0.048);
    hand.add(name + "_inner", name + "_middle", {0.0, 0.0, 0.048}, Vector3d::UnitY(), 0.0, 1.3,
             0.026);
    hand.add(name + "_middle", name + "_outer", {0.0, 0.0, 0.026}, Vector3d::UnitY(), 0.0, 1.3,
             0.022);
  };
  hand.add("palm", "thumb_base", {0.015, 0.03, 0.03}, Vector3d::UnitZ(), 0.0, 1.0);
  hand.add("thumb_base", "thumb_inner", {0.005, 0.02, 0.01}, Vector3d::UnitX(), -1.0, 0.0, 0.04);
  hand.add("thumb_inner", "thumb_outer", {0.0, 0.03, 0.03}, Vector3d::UnitX(), -1.3, 0.0, 0.03);
  geometric::Joint& fold =
      hand.add("palm", "fold", {0.01, -0.02, 0.01}, -Vector3d::UnitZ(), 0.0, 1.0, 0.02);
  if (folds) {
    fold.mimic = geometric::Mimic{"thumb_base_joint", 1.0, 0.0};
  } else {
    fold.type = JointType::kFixed;
  }
  add_finger("palm", "index", {0.0, 0.025, 0.11});
  add_finger("palm", "middle", {0.0, 0.0, 0.11});
  add_finger("fold", "ring", {-0.01, 0.0, 0.095});
  add_finger("fold", "little", {-0.01, -0.02, 0.085});
  return hand.model();
}

TEST(HandsOfOtherMakers, BaseFingersOnAFoldingPalmAtTheirOwnFirstJoints) {
  const auto folding = folding_palm(true);
  const RobotFingers fingers = find_fingers(*folding);
  const RobotFingers rigid = find_fingers(*folding_palm(false));
  ASSERT_EQ(fingers.fingers.size(), 5U);
  std::vector<double> errors;
  for (const bool folds : {true, false}) {
    const auto model = folding_palm(folds);
    RetargetingSettings settings;
    settings.self_collision = false;
    const FingertipRetargeter hand(model, settings);
    std::vector<GloveAngles> rows;
    for (const double degrees : {0.0, 20.0, 40.0, 60.0}) {
      rows.push_back(closed(degrees));
    }
    Eigen::MatrixXd postures(std::ssize(rows), std::ssize(hand.joints()));
    Eigen::VectorXd last = hand.middle();
    for (std::size_t row = 0; row < rows.size(); ++row) {
      last = hand.posture(hand.landmarks(rows[row]), last);
      postures.row(static_cast<Eigen::Index>(row)) = last.transpose();
    }
    errors.push_back(fingertip_errors(rows, hand.joints(), postures, hand).median);
  }
  for (std::size_t f = 0; f < fingers.fingers.size(); ++f) {
    EXPECT_NEAR(fingers.fingers[f].reach, rigid.fingers[f].reach, 1e-9) << f;
    EXPECT_LT((fingers.fingers[f].p_PB - rigid.fingers[f].p_PB).norm(), 0.02) << f;
  }
  EXPECT_LT(errors[0], 0.025) << "m, at the fingertips";
  EXPECT_LT(errors[0], errors[1] + 0.005) << "as near as with a palm that does not fold";
}

/// The hand has two equal fingers that bend equally in both directions, and a third one in their
/// plane.
TEST(HandsOfOtherMakers, AreDoubtedWhereNothingTellsToWhichSideTheyClose) {
  HandBuilder hand("star");
  for (const double y : {-0.03, 0.0, 0.03}) {
    const std::string name = "f" + std::to_string(std::lround(1000.0 * (y + 0.1)));
    hand.add("palm", name, {0.0, y, 0.08}, Vector3d::UnitY(), -1.5, 1.5, 0.05);
    hand.add(name, name + "_outer", {0.0, 0.0, 0.05}, Vector3d::UnitY(), -1.5, 1.5, 0.03);
  }
  const auto model = hand.model();
  const HandMapping mapping = propose_mapping(*model);
  EXPECT_THAT(mapping_doubts(mapping, *model), testing::Contains(HasSubstr("to which side")));
  EXPECT_THAT(mapping.source, HasSubstr("Not certain"));
}

TEST(HandsOfOtherMakers, AreDoubtedIfTheyOpenWhenThePersonCloses) {
  const auto model = offset_hand(0.011, -1.0, 1.57).model();
  HandMapping mapping = propose_mapping(*model);
  for (JointMapping& mapped : mapping.joints) {
    mapped.gain =
        mapped.joint.starts_with("ring") && is_flexion(mapped) ? -mapped.gain : mapped.gain;
  }
  EXPECT_THAT(mapping_doubts(mapping, *model),
              testing::Contains(HasSubstr("ring finger does not bend to the palm")));
}

TEST(ClampingWarning, NamesTheWorstJointWhereMostSamplesAreBeyondLimits) {
  MappedPostures mapped;
  mapped.joints = {"knuckle", "middle"};
  mapped.postures = Eigen::MatrixXd::Zero(10, 2);
  mapped.unclamped = mapped.postures;
  mapped.clamped = {4, 0};
  mapped.unclamped.col(0).head(4).setConstant(0.5);
  EXPECT_EQ(clamping_warning(mapped), "");
  mapped.clamped = {8, 0};
  mapped.unclamped.col(0).head(8).setConstant(0.5);
  EXPECT_THAT(clamping_warning(mapped), HasSubstr("80 % of the samples"));
  EXPECT_THAT(clamping_warning(mapped), HasSubstr("knuckle"));
}

}  // namespace
}  // namespace handway::device
