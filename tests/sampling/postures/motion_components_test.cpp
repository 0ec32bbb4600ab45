#include "handway/sampling/postures/motion_components.h"

#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace handway::sampling {
namespace {

Eigen::VectorXd function_of_time(double half_waves) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(kMotionPoints, 0.0, 1.0);
  return (half_waves * std::numbers::pi * time.array()).sin();
}

/// Motions of three joints by two functions of time with drawn weights. The third joint rests.
class MotionComponentsOfTwoFunctions : public testing::Test {
 protected:
  [[nodiscard]] static HandMotion motion(double first, double second) {
    HandMotion result{0.0, 1.0, Eigen::MatrixXd::Constant(kMotionPoints, 3, 0.5)};
    result.joints.col(0) += first * function_of_time(1.0);
    result.joints.col(1) += second * function_of_time(2.0) - first * function_of_time(1.0);
    return result;
  }

  MotionComponentsOfTwoFunctions() {
    RandomStream draw(7);
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd weights = draw.uniform(2);
      motions_.push_back(motion(0.4 * weights[0], 0.3 * weights[1]));
    }
  }

  std::vector<HandMotion> motions_;
};

TEST_F(MotionComponentsOfTwoFunctions, RepresentEveryWeightedSumOfThem) {
  const MotionComponents components(motions_);
  EXPECT_EQ(components.count(), 2);
  EXPECT_EQ(components.motions(), motions_.size());
  EXPECT_LT(components.errors(motion(-0.2, 0.9).joints).maxCoeff(), 1e-9);
  EXPECT_LT(components.held_out_errors().maxCoeff(), 1e-9);
}

TEST_F(MotionComponentsOfTwoFunctions, CantRepresentAnotherFunction) {
  const MotionComponents components(motions_);
  HandMotion other = motion(0.1, 0.1);
  other.joints.col(0) += 0.2 * function_of_time(3.0);
  const Eigen::VectorXd errors = components.errors(other.joints);
  ASSERT_EQ(errors.size(), 2);
  EXPECT_NEAR(errors[0], 0.2 / std::numbers::sqrt2, 0.003) << "the RMS of a sine";
  EXPECT_LT(errors[1], 0.003);
}

TEST_F(MotionComponentsOfTwoFunctions, TellAMotionFromItsReverse) {
  // Postures alone can't: they are the same. The hand bends early and stretches late, or reversed.
  std::vector<HandMotion> motions = motions_;
  const Eigen::VectorXd early =
      function_of_time(1.0).array() * (-function_of_time(0.5)).array().exp();
  for (HandMotion& motion : motions) {
    const double weight = motion.joints(kMotionPoints / 2, 0) - 0.5;
    motion.joints = Eigen::MatrixXd::Constant(kMotionPoints, 2, 0.5);
    motion.joints.col(0) += weight * early;
    motion.joints.col(1) += weight * early;
  }
  const MotionComponents components(motions);
  const Eigen::MatrixXd forwards = (0.5 + early.array()).replicate(1, 2);
  EXPECT_LT(components.errors(forwards).norm(), 1e-9);
  EXPECT_GT(components.errors(forwards.colwise().reverse()).norm(), 0.02);
}

TEST_F(MotionComponentsOfTwoFunctions, IgnoreJointsThatRest) {
  const MotionComponents components(motions_);
  EXPECT_EQ(components.joints(), (HandJointIndices{0, 1}));
  EXPECT_EQ(MotionComponents(motions_, {0}).joints(), (HandJointIndices{1}));
}

TEST_F(MotionComponentsOfTwoFunctions, HoldOutMotionsThatTheOthersDontExplain) {
  motions_.back().joints.col(0) += 0.3 * function_of_time(3.0);
  const MotionComponents components(motions_);
  const Eigen::MatrixXd& errors = components.held_out_errors();
  ASSERT_EQ(errors.rows(), 20);
  EXPECT_NEAR(errors(19, 0), 0.3 / std::numbers::sqrt2, 0.01);
  EXPECT_LT(components.errors(motions_.back().joints)[0], 0.1 * errors(19, 0))
      << "a motion is represented too well by components that were computed from it";
}

TEST_F(MotionComponentsOfTwoFunctions, NeedTenMotionsOfTheSameJoints) {
  std::vector<HandMotion> few(motions_.begin(), motions_.begin() + 9);
  EXPECT_THROW(MotionComponents{few}, std::invalid_argument);
  EXPECT_THROW(MotionComponents(motions_, {0, 1}), std::invalid_argument) << "nothing moves";
  EXPECT_THROW(MotionComponents(motions_, {3}), std::invalid_argument);
  motions_[3].joints.resize(kMotionPoints, 2);
  EXPECT_THROW(MotionComponents{motions_}, std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
