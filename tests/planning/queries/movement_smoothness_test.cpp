#include "handway/planning/queries/movement_smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace handway::planning {
namespace {

constexpr double kMinimumJerk = -5.322;  // -ln(204.8)

// The speed of a minimum-jerk movement (Flash and Hogan 1985): 30 a/T (τ² - 2 τ³ + τ⁴).
SpeedProfile minimum_jerk(double duration, double size, Eigen::Index samples) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(samples, 0.0, 1.0);
  return {duration / static_cast<double>(samples - 1),
          30.0 * size / duration * (t.square() - 2.0 * t.cube() + t.square().square())};
}

// The example of the authors' program (github.com/siva82kb/SPARC, scripts/smoothness.py).
SpeedProfile bell() {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(200, -1.0, 0.99);
  return {0.01, (-5.0 * t.square()).exp()};
}

// Movements one after the other.
SpeedProfile repeated(const SpeedProfile& movement, Eigen::Index times) {
  return {movement.period, movement.speed.replicate(times, 1)};
}

TEST(LogDimensionlessJerk, HasTheClosedFormOfAMinimumJerkMovement) {
  // T³/v² ∫ s̈² dt = 720 / 1.875² = 204.8.
  EXPECT_NEAR(std::log(720.0 / (1.875 * 1.875)), -kMinimumJerk, 1e-3);
  const auto smoothness = movement_smoothness(minimum_jerk(1.0, 1.0, 2001));
  ASSERT_TRUE(smoothness);
  EXPECT_NEAR(smoothness->log_dimensionless_jerk, kMinimumJerk, 2e-3);
}

TEST(LogDimensionlessJerk, IsThatOfTheAuthorsProgram) {
  // Their duration is one sample longer: it counts samples, not the periods between them.
  const double theirs = -5.81636;
  EXPECT_NEAR(movement_smoothness(bell())->log_dimensionless_jerk,
              theirs + 3.0 * std::log(200.0 / 199.0), 1e-3);
}

TEST(SpectralArcLength, IsThatOfTheAuthorsProgram) {
  EXPECT_NEAR(movement_smoothness(bell())->spectral_arc_length, -1.41403, 5e-6);
}

TEST(SpectralArcLength, IsAboutAsLongForAMinimumJerkMovement) {
  // Figures of the paper of 2015 show about -1.4 for a movement without submovements.
  EXPECT_NEAR(movement_smoothness(minimum_jerk(1.0, 1.0, 101))->spectral_arc_length, -1.4, 0.05);
}

TEST(MovementSmoothness, DependsNeitherOnSizeNorOnDuration) {
  const MovementSmoothness one = *movement_smoothness(minimum_jerk(1.0, 1.0, 101));
  const MovementSmoothness large = *movement_smoothness(minimum_jerk(1.0, 50.0, 101));
  EXPECT_NEAR(large.log_dimensionless_jerk, one.log_dimensionless_jerk, 1e-9);
  EXPECT_NEAR(large.spectral_arc_length, one.spectral_arc_length, 1e-9);
  const MovementSmoothness slow = *movement_smoothness(minimum_jerk(4.0, 1.0, 101));
  EXPECT_NEAR(slow.log_dimensionless_jerk, one.log_dimensionless_jerk, 1e-9);
  EXPECT_NEAR(slow.spectral_arc_length, one.spectral_arc_length, 1e-9);
}

TEST(MovementSmoothness, HardlyDependsOnThePeriod) {
  const MovementSmoothness coarse = *movement_smoothness(minimum_jerk(2.0, 1.0, 201));
  const MovementSmoothness fine = *movement_smoothness(minimum_jerk(2.0, 1.0, 801));
  EXPECT_NEAR(fine.log_dimensionless_jerk, coarse.log_dimensionless_jerk, 0.02);
  EXPECT_NEAR(fine.spectral_arc_length, coarse.spectral_arc_length, 0.01);
}

TEST(MovementSmoothness, FallsWithEveryStop) {
  MovementSmoothness last = *movement_smoothness(minimum_jerk(1.0, 1.0, 101));
  for (const Eigen::Index movements : {2, 3, 4}) {
    const MovementSmoothness with_stops =
        *movement_smoothness(repeated(minimum_jerk(1.0, 1.0, 101), movements));
    EXPECT_LT(with_stops.log_dimensionless_jerk, last.log_dimensionless_jerk - 1.0);
    EXPECT_LT(with_stops.spectral_arc_length, last.spectral_arc_length - 0.3);
    last = with_stops;
  }
}

TEST(MovementSmoothness, IsNothingWithoutMovement) {
  EXPECT_FALSE(movement_smoothness({0.01, Eigen::VectorXd::Zero(100)}));
  EXPECT_FALSE(movement_smoothness({0.01, Eigen::VectorXd::Ones(4)})) << "too few samples";
  EXPECT_FALSE(movement_smoothness({0.01, Eigen::VectorXd::Ones(100)})) << "no jerk at all";
  EXPECT_FALSE(movement_smoothness({0.0, Eigen::VectorXd::Ones(100)}));
  Eigen::VectorXd broken = Eigen::VectorXd::Ones(100);
  broken[50] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(movement_smoothness({0.01, broken}));
}

}  // namespace
}  // namespace handway::planning
