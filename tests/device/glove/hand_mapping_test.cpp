#include "handway/device/glove/hand_mapping.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using geometric::InputError;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::shared_ptr<const geometric::RobotModel> sah() {
  return geometric::load_robot(test::source_dir() / "resources" / "robots" / "sah_right" /
                               "sah_right.urdf");
}

GloveAngles angles(std::initializer_list<std::pair<const char*, double>> values) {
  GloveAngles result;
  for (const auto& [letter, angle] : values) {
    result.angles.at(static_cast<std::size_t>(*find_sensor(letter))) = angle;
  }
  return result;
}

class MappingFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "mapping.yaml"; }
  [[nodiscard]] std::string refusal(const std::string& joints) const {
    std::ofstream(file()) << "hand: sah_right\njoints:\n" << joints;
    try {
      (void)read_mapping(file());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(MappingFile, OfTable1IsTheOneThatShips) {
  write_mapping(table1_mapping(), file());
  const std::filesystem::path shipped =
      test::source_dir() / "resources" / "mappings" / "table1_sah.yaml";
  EXPECT_EQ(content(file()), content(shipped));
  write_mapping(read_mapping(shipped), file());
  EXPECT_EQ(content(file()), content(shipped));
}

TEST_F(MappingFile, OfTable1UsesElevenSensorsAsPrinted) {
  std::vector<std::string> letters;
  for (const JointMapping& mapped : table1_mapping().joints) {
    letters.push_back(
        mapped.sensor < 0
            ? "-"
            : std::string(1, cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].letter));
  }
  EXPECT_THAT(letters,
              ElementsAre("c", "c", "e", "f", "j", "g", "h", "-", "k", "l", "n", "o", "p"));
}

TEST_F(MappingFile, KeepsCurvesAndFixedValues) {
  HandMapping mapping;
  mapping.hand = "claw";
  mapping.joints = {{"a", 5, 1.0, 0.0, {{-0.1, 0.2}, {0.7, 1.5}}, {}},
                    {"b", -1, 1.0, 0.0, {}, 0.25}};
  write_mapping(mapping, file());
  const HandMapping read = read_mapping(file());
  ASSERT_EQ(read.joints.size(), 2U);
  ASSERT_EQ(read.joints[0].curve.size(), 2U);
  EXPECT_EQ(read.joints[0].curve[1].joint, 1.5);
  EXPECT_EQ(read.joints[1].fixed, 0.25);
}

TEST_F(MappingFile, KeepsJointsThatAreLeftToTheArm) {
  HandMapping mapping = table1_mapping();
  mapping.joints[0] = {"thumb_base", -1, 1.0, 0.0, {}, {}, true};
  write_mapping(mapping, file());
  EXPECT_THAT(content(file()), HasSubstr("{joint: thumb_base, arm: true}"));
  const HandMapper mapper(read_mapping(file()), *sah());
  EXPECT_EQ(mapper.joints().size(), 12U);
  EXPECT_EQ(mapper.joints()[0], "thumb_abduction");
  EXPECT_THAT(refusal("  - {joint: a, arm: true, sensor: g}\n"), HasSubstr("sensor"));
}

TEST_F(MappingFile, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(refusal("  - {joint: a, sensor: IndxMPJ}\n"),
              AllOf(HasSubstr("mapping.yaml:3"), HasSubstr("IndexMPJ")));
  EXPECT_THAT(refusal("  - {joint: a, sensor: g}\n  - {joint: a, sensor: h}\n"),
              AllOf(HasSubstr("mapping.yaml:4"), HasSubstr("second time")));
  EXPECT_THAT(refusal("  - {joint: a, sensor: g, fixed: 1}\n"), HasSubstr("sensor and fixed"));
  EXPECT_THAT(refusal("  - {joint: a}\n"), HasSubstr("neither"));
  EXPECT_THAT(refusal("  - {joint: a, sensor: g, curve: [[0, 0], [0, 1]]}\n"),
              HasSubstr("one above 0"));
  EXPECT_THAT(refusal("  - {joint: a, sensor: g, curve: [[0, 0]]}\n"), HasSubstr("two points"));
  EXPECT_THAT(refusal("  - {joint: a, sensor: g, gain: 2, curve: [[0, 0], [1, 1]]}\n"),
              HasSubstr("curve beside"));
  EXPECT_THAT(refusal("  []\n"), HasSubstr("no joints"));
}

TEST(HandMapper, MakesTheHandTakeThePostureOfTheGlove) {
  const HandMapper mapper(table1_mapping(), *sah());
  ASSERT_EQ(mapper.joints().size(), 13U);
  EXPECT_EQ(mapper.joints()[7], "middle_abduction");
  const Eigen::VectorXd posture =
      mapper.posture(angles({{"c", 0.6}, {"h", 0.5}, {"j", 0.1}, {"n", 0.1}, {"i", 1.0}}));
  EXPECT_DOUBLE_EQ(posture[0], -0.6);
  EXPECT_DOUBLE_EQ(posture[6], -0.5);
  EXPECT_DOUBLE_EQ(posture[4], -0.1);
  EXPECT_DOUBLE_EQ(posture[10], 0.1);
  EXPECT_DOUBLE_EQ(posture[7], 0.0);
  // Both joints of the thumb's base go through the same part of their ranges.
  const Eigen::VectorXd parts =
      (posture - mapper.lower()).cwiseQuotient(mapper.upper() - mapper.lower());
  EXPECT_NEAR(parts[0], parts[1], 1e-12);
}

TEST(HandMapper, SpreadsTheFingersWhenTheSensorsSpread) {
  const auto hand = sah();
  const HandMapper mapper(table1_mapping(), *hand);
  const auto tip_distance = [&](const GloveAngles& glove, const char* finger) {
    std::vector<geometric::Pose> poses(static_cast<std::size_t>(hand->link_count()));
    hand->forward_kinematics(mapper.posture(glove), poses);
    const auto tip = hand->find_link(std::string(finger) + "_tip");
    const auto middle = hand->find_link("middle_tip");
    return (poses.at(static_cast<std::size_t>(*tip)).translation() -
            poses.at(static_cast<std::size_t>(*middle)).translation())
        .norm();
  };
  EXPECT_GT(tip_distance(angles({{"j", 0.2}}), "index"), tip_distance(angles({}), "index") + 0.01);
  EXPECT_GT(tip_distance(angles({{"n", 0.2}}), "ring"), tip_distance(angles({}), "ring") + 0.01);
}

TEST(HandMapper, ClampsToTheLimitsAndCounts) {
  const HandMapper mapper(table1_mapping(), *sah());
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  for (const char letter : std::string("cefjghklnop")) {
    recording.header.sensors.push_back(*find_sensor(std::string(1, letter)));
  }
  recording.times = Eigen::Vector3d(0, 1, 2);
  recording.values = Eigen::MatrixXd::Constant(3, 11, 0.2);
  recording.values(1, 4) = 2.0;
  recording.values(2, 4) = -1.0;
  const MappedPostures mapped = mapper.map_recording(recording);
  EXPECT_EQ(mapped.postures.rows(), 3);
  EXPECT_THAT(mapped.clamped, ElementsAre(0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_DOUBLE_EQ(mapped.postures(1, 5), mapper.lower()[5]);
  EXPECT_DOUBLE_EQ(mapped.unclamped(1, 5), -2.0);
}

TEST(HandMapper, FollowsCurvesAndHoldsTheirEnds) {
  HandMapping mapping = table1_mapping();
  mapping.joints[5].curve = {{0.0, -0.1}, {1.0, -0.5}, {2.0, -1.2}};
  const HandMapper mapper(mapping, *sah());
  EXPECT_DOUBLE_EQ(mapper.posture(angles({{"g", -1.0}}))[5], -0.1);
  EXPECT_DOUBLE_EQ(mapper.posture(angles({{"g", 0.5}}))[5], -0.3);
  EXPECT_DOUBLE_EQ(mapper.posture(angles({{"g", 1.5}}))[5], -0.85);
  EXPECT_DOUBLE_EQ(mapper.posture(angles({{"g", 9.0}}))[5], -1.2);
}

TEST(HandMapper, HoldsTheMiddleWhereASensorIsMissing) {
  const HandMapper mapper(table1_mapping(), *sah());
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(mapper.posture(angles({{"c", nothing}}))[0], -std::numbers::pi / 4);
}

TEST(HandMapper, RefusesMappingsForOtherHandsAndRecordingsWithoutASensor) {
  HandMapping mapping = table1_mapping();
  mapping.joints[3].joint = "thumb_medal";
  EXPECT_THROW(HandMapper(mapping, *sah()), InputError);
  mapping = table1_mapping();
  mapping.joints.pop_back();
  EXPECT_THROW(HandMapper(mapping, *sah()), InputError);
  Recording recording;
  recording.header = {RecordingKind::kAngles, "", "", "", {0, 1}};
  recording.times = Eigen::Vector2d(0, 1);
  recording.values = Eigen::Matrix2d::Zero();
  const HandMapper mapper(table1_mapping(), *sah());
  EXPECT_THROW((void)mapper.map_recording(recording), InputError);
  recording.header.kind = RecordingKind::kCounts;
  EXPECT_THROW((void)mapper.map_recording(recording), InputError);
}

}  // namespace
}  // namespace handway::device
