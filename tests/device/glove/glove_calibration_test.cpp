#include "handway/device/glove/glove_calibration.h"

#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CalibrationFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    std::ofstream(file()) << text;
    return file();
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "calibration"; }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)read_calibration(write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(CalibrationFile, IsReadAsItWasWritten) {
  GloveCalibration calibration;
  calibration.person = "A \"B\"";
  calibration.date = "2026-03-01";
  calibration.sensors[4] = SensorCalibration{0.1 / 3, 79.5, 0.01};
  calibration.sensors[14] = SensorCalibration{-0.0056, 133.0, std::nullopt};
  write_calibration(calibration, file());
  const GloveCalibration read = read_calibration(file());
  EXPECT_EQ(read.person, "A \"B\"");
  EXPECT_EQ(read.date, "2026-03-01");
  ASSERT_TRUE(read.sensors[4] && read.sensors[14]);
  EXPECT_EQ(read.sensors[4]->gain, 0.1 / 3);
  EXPECT_EQ(read.sensors[4]->zero, 79.5);
  EXPECT_EQ(read.sensors[4]->residual, 0.01);
  EXPECT_EQ(read.sensors[14]->residual, std::nullopt);
  EXPECT_EQ(read.sensors[0], std::nullopt);
}

TEST_F(CalibrationFile, OfPointPairsTurnsFlexionPositive) {
  std::string text;
  for (int line = 0; line < 22; ++line) {
    text += line == 6 ? "0:117 -1.5:185\n" : "0.25:100 -0.75:150\n";
  }
  const GloveCalibration read = read_calibration(write(text));
  const auto& index = read.sensors.at(static_cast<std::size_t>(*find_sensor("IndexMPJ")));
  ASSERT_TRUE(index);
  EXPECT_NEAR(index->gain, 1.5 / 68, 1e-12);
  EXPECT_NEAR(index->zero, 117.0, 1e-9);
  const auto& other = read.sensors.at(static_cast<std::size_t>(*find_sensor("PalmArch")));
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->gain * (100 - other->zero), -0.25, 1e-12);
  EXPECT_NEAR(other->gain * (150 - other->zero), 0.75, 1e-12);
}

TEST_F(CalibrationFile, OfVirtualHandIsReadBySlots) {
  std::string text = "a title\n";
  for (int slot = 0; slot < 24; ++slot) {
    text += slot % 4 == 0 ? "Finger\n" : "";
    text += std::to_string(slot) + ' ' + std::to_string(100 + slot) +
            (slot == 7 || slot == 23 ? " 0 0\n" : " -0.015 0\n");
  }
  const GloveCalibration read = read_calibration(write(text));
  const auto& ring = read.sensors.at(static_cast<std::size_t>(*find_sensor("RingMPJ")));
  ASSERT_TRUE(ring);
  EXPECT_EQ(ring->zero, 112.0);
  EXPECT_EQ(ring->gain, 0.015);
}

TEST_F(CalibrationFile, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(refusal("sensors:\n  IndxMPJ: {gain: 1, zero: 2}\n"), HasSubstr("IndexMPJ"));
  EXPECT_THAT(refusal("sensors:\n  IndexMPJ: {gain: 0, zero: 2}\n"), HasSubstr("other than 0"));
  EXPECT_THAT(refusal("nothing\n"), HasSubstr("22 lines"));
  EXPECT_THAT(refusal(" \n\"\n"), HasSubstr("blank lines alone"));
  std::string text;
  for (int line = 0; line < 22; ++line) {
    text += line == 3 ? "0:100 -1:105\n" : "0:100 -1:150\n";
  }
  EXPECT_THAT(refusal(text), HasSubstr("calibration:4: ThumbRotate: found points 5 counts apart"));
  EXPECT_THAT(refusal("0:100 -1:150\n"), HasSubstr("1 lines of points"));
}

TEST(GloveCalibrationOfNobody, TurnsCountsToAnglesAndBack) {
  const GloveCalibration typical = typical_calibration();
  GloveAngles angles;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    ASSERT_TRUE(typical.sensors.at(i)) << i;
    angles.angles.at(i) = 0.1;
  }
  angles.angles[3] = std::numeric_limits<double>::quiet_NaN();
  const GloveFrame frame = to_counts(angles, typical);
  EXPECT_EQ(frame.counts[3], 0);
  const GloveAngles back = to_angles(frame, typical);
  EXPECT_TRUE(std::isnan(back.angles[3]));
  EXPECT_NEAR(back.angles[5], 0.1, 0.5 * typical.sensors[5]->gain);
  angles.angles[5] = 100.0;
  EXPECT_EQ(to_counts(angles, typical).counts[5], 255);
}

TEST(GloveCalibrationOfNobody, KeepsFullFlexionWithinTheCounts) {
  const GloveCalibration typical = typical_calibration();
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    const auto [least, most] = typical_angle_ranges().at(i);
    const SensorCalibration& line = typical.sensors.at(i).value();
    EXPECT_GT(line.zero + least / line.gain, 1.0) << cyberglove_sensors()[i].name;
    EXPECT_LT(line.zero + most / line.gain, 255.0) << cyberglove_sensors()[i].name;
  }
}

Recording held(double index, double middle) {
  Recording recording;
  recording.header = {RecordingKind::kCounts, "", "", "", {4, 7}};
  recording.times = Eigen::Vector3d(0, 0.01, 0.02);
  recording.values = Eigen::MatrixXd(3, 2);
  recording.values.col(0).setConstant(index);
  recording.values.col(1).setConstant(middle);
  recording.values(0, 0) -= 1.0;
  recording.values(2, 0) += 1.0;
  return recording;
}

GuidedPose pose(const std::string& name, double angle, const Recording& counts) {
  GuidedPose result;
  result.name = name;
  result.angles.fill(std::numeric_limits<double>::quiet_NaN());
  result.angles[4] = angle;
  result.angles[7] = angle;
  result.counts = counts;
  return result;
}

TEST(CalibrationFromPoses, IsTheLineOfLeastSquares) {
  const CalibrationFit fit =
      calibrate_from_poses({pose("flat", 0.0, held(80, 90)), pose("half", 0.8, held(130, 93)),
                            pose("fist", 1.5, held(180, 94))},
                           "A", "2026-03-01");
  const auto& index = fit.calibration.sensors[4];
  ASSERT_TRUE(index);
  EXPECT_NEAR(index->gain, 0.015, 1e-12);
  EXPECT_NEAR(index->zero, 130.0 - (2.3 / 3) / 0.015, 1e-9);
  EXPECT_NEAR(*index->residual, std::sqrt(0.5) / 30, 1e-9);
  EXPECT_FALSE(fit.calibration.sensors[7]);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("MiddleMPJ is dead")));
  EXPECT_FALSE(fit.calibration.sensors[0]);
}

TEST(CalibrationFromPoses, WarnsOfSensorsThatDoNotFollow) {
  const CalibrationFit fit =
      calibrate_from_poses({pose("flat", 0.0, held(80, 255)), pose("half", 0.8, held(200, 93)),
                            pose("fist", 1.5, held(120, 94))},
                           "A", "");
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("IndexMPJ is off")));
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("flat: sensor MiddleMPJ is at an end")));
  EXPECT_THROW((void)calibrate_from_poses({}, "A", ""), InputError);
}

TEST(CalibrationFromRange, LaysTheMotionOnTheRange) {
  Recording free = held(0, 0);
  free.header.sensors = {4, 14};
  free.times = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  free.values.resize(101, 2);
  free.values.col(0) = Eigen::VectorXd::LinSpaced(101, 50.0, 150.0);
  free.values.col(1).setConstant(99.0);
  AngleRanges ranges{};
  ranges[4] = {-0.49, 0.49};
  GloveCalibration signs;
  signs.sensors[4] = SensorCalibration{-0.02, 100.0, std::nullopt};
  signs.sensors[14] = SensorCalibration{0.5, 1.0, std::nullopt};
  const CalibrationFit fit = calibrate_from_range(free, ranges, signs, "A", "");
  ASSERT_TRUE(fit.calibration.sensors[4]);
  EXPECT_NEAR(fit.calibration.sensors[4]->gain, -0.01, 1e-12);
  EXPECT_NEAR(fit.calibration.sensors[4]->zero, 100.0, 1e-9);
  ASSERT_TRUE(fit.calibration.sensors[14]);
  EXPECT_EQ(fit.calibration.sensors[14]->gain, 0.5);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("RingMiddleAbduct is dead")));
}

TEST(RecordingOfCounts, BecomesOneOfAnglesWithoutSensorsThatAreNotCalibrated) {
  GloveCalibration calibration;
  calibration.sensors[7] = SensorCalibration{0.5, 90.0, std::nullopt};
  const Recording angles = to_angles(held(80, 92), calibration);
  EXPECT_EQ(angles.header.kind, RecordingKind::kAngles);
  ASSERT_EQ(angles.values.cols(), 1);
  EXPECT_EQ(angles.values(0, 0), 1.0);
  EXPECT_THAT(angles.warnings, Contains(HasSubstr("IndexMPJ")));
  EXPECT_THAT(to_angles(angles, GloveCalibration{}).warnings, Not(IsEmpty()));
}

TEST_F(CalibrationFile, KeepsRangesAndBonesOfAPerson) {
  GloveCalibration person;
  person.ranges[4] = std::pair(-0.2, 1.4);
  person.bones = typical_bones(0.17);
  write_calibration(person, file());
  const GloveCalibration read = read_calibration(file());
  ASSERT_TRUE(read.ranges[4] && read.bones);
  EXPECT_NEAR(read.ranges[4]->second, 1.4, 1e-3);
  EXPECT_FALSE(read.ranges[5]);
  EXPECT_NEAR(read.bones->at(2)[1], typical_bones(0.17).at(2)[1], 1e-5);
  ASSERT_TRUE(read.sensors[4]) << "counts are read as those of a typical hand";
  EXPECT_EQ(read.sensors[4]->gain, typical_calibration().sensors[4]->gain);
}

TEST_F(CalibrationFile, RefusesRangesAndBonesThatAreNone) {
  EXPECT_THAT(refusal("ranges:\n  IndexMPJ: [80, -10]\n"), HasSubstr("least and most"));
  EXPECT_THAT(refusal("ranges:\n  IndxMPJ: [0, 80]\n"), HasSubstr("IndexMPJ"));
  EXPECT_THAT(refusal("bones:\n  thumb: [30, 0, 30, 30]\n"), HasSubstr("above 0"));
}

Recording bending_index(double least, double most) {
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  recording.header.sensors = {*find_sensor("IndexMPJ"), *find_sensor("IndexPIJ")};
  recording.times = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
  recording.values = Eigen::MatrixXd::Zero(201, 2);
  recording.values.col(0).setLinSpaced(least, most);
  return recording;
}

TEST(PersonRanges, AreWhatTheJointsWentThroughAndMakeTheAnglesOfATypicalHand) {
  const int knuckle = *find_sensor("IndexMPJ");
  const PersonRanges ranges = measured_ranges(bending_index(-0.4, 0.8));
  ASSERT_TRUE(ranges.at(static_cast<std::size_t>(knuckle)));
  EXPECT_FALSE(ranges.at(static_cast<std::size_t>(*find_sensor("IndexPIJ")))) << "it did not move";
  const auto [least, most] = *ranges.at(static_cast<std::size_t>(knuckle));
  const auto& typical = typical_angle_ranges().at(static_cast<std::size_t>(knuckle));
  EXPECT_NEAR(most, 0.8, 0.03);
  EXPECT_NEAR(typical_angle(ranges, knuckle, most), typical.second, 1e-9);
  EXPECT_NEAR(typical_angle(ranges, knuckle, least), typical.first, 1e-9);
  EXPECT_EQ(typical_angle(ranges, knuckle, 0.0), 0.0);
  EXPECT_EQ(typical_angle(ranges, *find_sensor("IndexPIJ"), 0.7), 0.7);
}

}  // namespace
}  // namespace handway::device
