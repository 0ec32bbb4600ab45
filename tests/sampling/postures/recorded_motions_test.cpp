#include "handway/sampling/postures/recorded_motions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace handway::sampling {
namespace {

constexpr double kRate = 64.0;  // Hz, as a glove's

// From 0 to 1 with the speed of a minimum-jerk movement; at rest before and after.
double minimum_jerk(double time) {
  const double t = std::fmin(std::fmax(time, 0.0), 1.0);
  return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

/// Two joints that move for a second from `begins` on, in turn there and back.
struct Recorded {
  Eigen::VectorXd times;
  Eigen::MatrixXd postures;

  Recorded(double duration, const std::vector<double>& begins, double size = 0.5)
      : times(Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(duration * kRate) + 1, 0.0,
                                         duration)),
        postures(Eigen::MatrixXd::Constant(times.size(), 2, 0.2)) {
    for (Eigen::Index row = 0; row < times.size(); ++row) {
      double sign = 1.0;
      for (const double begin : begins) {
        postures.row(row).array() += sign * size * minimum_jerk(times[row] - begin);
        sign = -sign;
      }
    }
  }
};

TEST(CutIntoMotions, FindsMotionsBetweenRests) {
  const Recorded recorded(8.0, {1.0, 4.0, 6.0});
  const std::vector<HandMotion> motions = cut_into_motions(recorded.times, recorded.postures);
  ASSERT_EQ(motions.size(), 3U);
  const std::vector<double> begins{1.0, 4.0, 6.0};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    // The speed of a minimum-jerk movement is above a tenth of its peak for 85 % of the time.
    EXPECT_NEAR(motions[i].begin, begins[i] + 0.075, 0.08);
    EXPECT_NEAR(motions[i].duration(), 0.85, 0.1);
    EXPECT_EQ(motions[i].joints.rows(), kMotionPoints);
  }
}

TEST(CutIntoMotions, CutsWhereTheHandOnlySlowsDown) {
  // Forth and back without a rest: the hand turns around at 2 s.
  const Recorded recorded(4.0, {1.0, 2.0});
  const std::vector<HandMotion> motions = cut_into_motions(recorded.times, recorded.postures);
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_NEAR(motions[0].end, 2.0, 0.1);
  EXPECT_GT(motions[0].joints(kMotionPoints - 1, 0), motions[0].joints(0, 0));
  EXPECT_LT(motions[1].joints(kMotionPoints - 1, 0), motions[1].joints(0, 0));
}

TEST(CutIntoMotions, LeavesOutSmallMotions) {
  const Recorded tremor(8.0, {1.0, 4.0, 6.0}, 0.05);  // within 0.07 of the first posture
  EXPECT_TRUE(cut_into_motions(tremor.times, tremor.postures).empty());
}

TEST(CutIntoMotions, BeginsAnewWhereTimeFallsOrJumps) {
  const Recorded one(1.5, {0.25});
  const Eigen::Index rows = one.times.size();
  Eigen::VectorXd times(2 * rows);
  Eigen::MatrixXd postures(2 * rows, 2);
  times << one.times, one.times;
  postures << one.postures, one.postures;
  EXPECT_EQ(cut_into_motions(times, postures).size(), 2U);
  times.tail(rows).array() += 60.0;
  EXPECT_EQ(cut_into_motions(times, postures).size(), 2U) << "the minute between is no motion";
}

TEST(CutIntoMotions, FindsNothingInAHandAtRest) {
  EXPECT_TRUE(cut_into_motions(Eigen::VectorXd(), Eigen::MatrixXd(0, 2)).empty());
  const Recorded rest(3.0, {});
  EXPECT_TRUE(cut_into_motions(rest.times, rest.postures).empty());
}

TEST(CutIntoMotions, WantsATimeForEveryRow) {
  EXPECT_THROW(static_cast<void>(cut_into_motions(Eigen::VectorXd(3), Eigen::MatrixXd(2, 2))),
               std::invalid_argument);
}

TEST(WholeMotion, LeavesOutTheRestsAtBothEnds) {
  const Recorded recorded(4.0, {1.0});
  const std::optional<HandMotion> motion = whole_motion(recorded.times, recorded.postures);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin, 1.075, 0.08);
  EXPECT_NEAR(motion->end, 1.925, 0.08);
}

TEST(WholeMotion, KeepsPausesWithin) {
  const Recorded recorded(8.0, {1.0, 6.0});
  const std::optional<HandMotion> motion = whole_motion(recorded.times, recorded.postures);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->duration(), 5.85, 0.2);
}

TEST(WholeMotion, IsNothingForAHandAtRest) {
  const Recorded rest(3.0, {});
  EXPECT_FALSE(whole_motion(rest.times, rest.postures));
  EXPECT_FALSE(whole_motion(Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Random(2, 2)))
      << "no time passes";
}

TEST(TimeNormalised, InterpolatesBetweenRows) {
  const Eigen::Vector3d times(0.0, 1.0, 4.0);
  const Eigen::Vector3d values(0.0, 2.0, 8.0);
  const Eigen::MatrixXd even = time_normalised(times, values, 5);
  EXPECT_TRUE(even.isApprox((Eigen::VectorXd(5) << 0.0, 2.0, 4.0, 6.0, 8.0).finished(), 1e-12))
      << even;
}

}  // namespace
}  // namespace handway::sampling
