#include "features/glove/captured_postures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace handway::test {
namespace {

using gui::CapturedPostures;

// Postures that vary along (1, 1, 0) most, a little across.
Eigen::VectorXd posture_at(double time) {
  const double along = 0.3 * std::sin(1.3 * time);
  const double across = 0.05 * std::sin(3.1 * time + 0.4);
  return Eigen::Vector3d(0.5 + along, 0.5 + along + across, 0.5 - across);
}

TEST(CapturedPostures, SettleWhenTheirSubspaceNoLongerTurns) {
  CapturedPostures postures({"a", "b", "c"}, {});
  for (double time = 0.0; time < 29.0; time += 0.02) {
    postures.add(time, posture_at(time));
    EXPECT_FALSE(postures.has_settled());
  }
  for (double time = 29.0; time < 45.0; time += 0.02) {
    postures.add(time, posture_at(time));
  }
  ASSERT_TRUE(postures.turn().has_value());
  EXPECT_LT(*postures.turn(), CapturedPostures::kSettledAngle);
  EXPECT_TRUE(postures.has_settled());
}

TEST(CapturedPostures, AreNoLongerSettledWhenANewMotionBegins) {
  CapturedPostures postures({"a", "b", "c"}, {});
  for (double time = 0.0; time < 40.0; time += 0.02) {
    postures.add(time, posture_at(time));
  }
  ASSERT_TRUE(postures.has_settled());
  bool unsettled = false;
  for (double time = 40.0; time < 60.0; time += 0.02) {
    postures.add(time, Eigen::Vector3d(0.5, 0.5, 0.5 + 0.5 * std::sin(4.0 * time)));
    unsettled = unsettled || !postures.has_settled();
  }
  EXPECT_TRUE(unsettled);
}

TEST(CapturedPostures, KeepSomeThousandEvenly) {
  CapturedPostures postures({"a"}, {});
  for (int i = 0; i < 20000; ++i) {
    postures.add(0.01 * i, Eigen::VectorXd::Constant(1, i / 20000.0));
  }
  EXPECT_EQ(postures.count(), 20000);
  ASSERT_GT(postures.samples().size(), 2000U);
  EXPECT_LE(postures.samples().size(), 4000U);
  const double step = postures.samples()[1][0] - postures.samples()[0][0];
  EXPECT_NEAR(postures.samples()[2001][0] - postures.samples()[2000][0], step, 1e-12);
  EXPECT_GT(postures.samples().back()[0], 0.99);
}

TEST(CapturedPostures, CorrelateJointsAsPearsonDid) {
  CapturedPostures postures({"a", "b", "fixed"}, {});
  std::mt19937 random(4);
  std::normal_distribution<double> noise;
  Eigen::MatrixXd all(400, 2);
  for (int i = 0; i < 400; ++i) {
    const double a = noise(random);
    all.row(i) << 0.5 + 0.1 * a, 0.5 - 0.05 * a + 0.05 * noise(random);
    postures.add(0.01 * i, Eigen::Vector3d(all(i, 0), all(i, 1), 0.5));
  }
  const Eigen::MatrixXd centred = all.rowwise() - all.colwise().mean();
  const double expected =
      centred.col(0).dot(centred.col(1)) / (centred.col(0).norm() * centred.col(1).norm());
  const Eigen::MatrixXd correlations = postures.correlations();
  EXPECT_NEAR(correlations(0, 1), expected, 1e-9);
  EXPECT_NEAR(correlations(1, 1), 1.0, 1e-9);
  EXPECT_EQ(correlations(2, 0), 0.0);
}

}  // namespace
}  // namespace handway::test
