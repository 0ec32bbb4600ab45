#include "handway/device/glove/recording_filters.h"

#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/input_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace handway::device {
namespace {

using geometric::InputError;
using testing::Contains;
using testing::HasSubstr;

Recording sine(double frequency, double rate, Eigen::Index rows) {
  Recording recording;
  recording.header = {RecordingKind::kAngles, "", "", "", {4}};
  recording.times = Eigen::VectorXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1) / rate);
  recording.values = (2 * std::numbers::pi * frequency * recording.times.array()).sin().matrix();
  return recording;
}

double middle_amplitude(const Recording& recording) {
  return recording.values.middleRows(recording.values.rows() / 4, recording.values.rows() / 2)
      .cwiseAbs()
      .maxCoeff();
}

TEST(LowPass, TakesThreeDecibelsAtItsCutoffAndDelaysNothing) {
  EXPECT_NEAR(middle_amplitude(low_passed(sine(5.0, 100.0, 2000), 5.0)), std::sqrt(0.5), 0.01);
  EXPECT_LT(middle_amplitude(low_passed(sine(20.0, 100.0, 2000), 5.0)), 0.01);
  const Recording slow = sine(0.3, 100.0, 2000);
  EXPECT_LT((low_passed(slow, 5.0).values - slow.values).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LowPass, KeepsWhatIsStill) {
  Recording recording = sine(0.0, 50.0, 20);
  recording.values.setConstant(0.7);
  EXPECT_LT((low_passed(recording, 2.0).values.array() - 0.7).abs().maxCoeff(), 1e-12);
}

TEST(LowPass, NeedsARateWellAboveIt) {
  EXPECT_THROW((void)low_passed(sine(1.0, 20.0, 50), 10.0), InputError);
}

TEST(LowPass, MakesTimesEven) {
  Recording recording = sine(0.5, 100.0, 500);
  recording.times[100] += 0.004;
  const Recording smooth = low_passed(recording, 5.0);
  EXPECT_NEAR(smooth.times[101] - smooth.times[100], 0.01, 1e-9);
}

TEST(Resampling, GoesStraightBetweenRows) {
  Recording recording = sine(0.0, 10.0, 3);
  recording.times << 0.0, 1.0, 3.0;
  recording.values << 0.0, 1.0, -1.0;
  const Recording even = resampled(recording, 2.0);
  ASSERT_EQ(even.times.size(), 7);
  EXPECT_EQ(even.values(1, 0), 0.5);
  EXPECT_EQ(even.values(2, 0), 1.0);
  EXPECT_EQ(even.values(4, 0), 0.0);
  EXPECT_EQ(even.values(6, 0), -1.0);
  EXPECT_THROW((void)resampled(sine(0.0, 1.0, 1), 2.0), InputError);
}

TEST(Duplicates, AreLeftOutAndCounted) {
  Recording recording = sine(0.0, 10.0, 5);
  recording.values << 1, 1, 2, 2, 1;
  EXPECT_EQ(assess(recording).duplicates, 2);
  const Recording kept = without_duplicates(recording);
  ASSERT_EQ(kept.times.size(), 3);
  EXPECT_NEAR(kept.times[1], 0.2, 1e-12);
}

TEST(Trimming, KeepsBothEnds) {
  const Recording recording = sine(1.0, 1.0, 11);
  const Recording part = trimmed(recording, 2.0, 5.0);
  EXPECT_EQ(part.times.size(), 4);
  EXPECT_EQ(part.times[3], 5.0);
  EXPECT_THROW((void)trimmed(recording, 20.0, 30.0), InputError);
}

TEST(Quality, TellsRateAndGaps) {
  Recording recording = sine(1.0, 100.0, 101);
  recording.times.tail(50).array() += 1.0;
  const RecordingQuality quality = assess(recording);
  EXPECT_NEAR(quality.rate, 100.0, 1e-6);
  EXPECT_EQ(quality.gaps, 1);
  EXPECT_NEAR(quality.largest_gap, 1.01, 1e-9);
  EXPECT_NEAR(quality.duration, 2.0, 1e-9);
  EXPECT_THAT(quality.warnings, Contains(HasSubstr("1 gaps")));
}

TEST(Quality, FindsDeadNoisyAndSaturatedSensors) {
  Recording recording;
  recording.header = {RecordingKind::kCounts, "", "", "", {4, 5, 6, 7}};
  const Eigen::Index rows = 200;
  recording.times = Eigen::VectorXd::LinSpaced(rows, 0.0, 2.0);
  recording.values.resize(rows, 4);
  for (Eigen::Index row = 0; row < rows; ++row) {
    recording.values(row, 0) = 100.0;
    recording.values(row, 1) = row % 2 == 0 ? 100.0 : 120.0;
    recording.values(row, 2) = std::min(255.0, 100.0 + static_cast<double>(row));
    recording.values(row, 3) = 50.0 + static_cast<double>(row) / 2;
  }
  const RecordingQuality quality = assess(recording);
  EXPECT_TRUE(quality.sensors[0].dead);
  EXPECT_TRUE(quality.sensors[1].noisy);
  EXPECT_TRUE(quality.sensors[2].saturated);
  EXPECT_FALSE(quality.sensors[3].dead || quality.sensors[3].noisy || quality.sensors[3].saturated);
  EXPECT_EQ(quality.warnings.size(), 3U);
}

TEST(Percentiles, LieBetweenNeighbours) {
  EXPECT_EQ(percentile(Eigen::Vector3d(3, 1, 2), 0.5), 2.0);
  EXPECT_EQ(percentile(Eigen::Vector3d(3, 1, 2), 0.75), 2.5);
  EXPECT_EQ(percentile(Eigen::Vector3d(3, 1, 2), 1.0), 3.0);
}

}  // namespace
}  // namespace handway::device
