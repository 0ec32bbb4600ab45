#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace handway::sampling {
namespace {

constexpr int kJoints = 13;
constexpr double kTolerance = 1e-10;

// Postures far from 0 that vary differently along mixed directions.
Eigen::MatrixXd postures(Eigen::Index samples, std::uint64_t seed) {
  RandomStream stream(seed);
  Eigen::MatrixXd mixing(kJoints, kJoints);
  for (double& entry : mixing.reshaped()) {
    entry = 0.1 * stream.normal();
  }
  Eigen::MatrixXd result(samples, kJoints);
  for (Eigen::Index row = 0; row < samples; ++row) {
    result.row(row) = (mixing * stream.normal(kJoints)).transpose().array() + 0.5;
  }
  return result;
}

void add_all(const Eigen::MatrixXd& samples, IncrementalComponents& components) {
  for (const auto& row : samples.rowwise()) {
    components.add(row.transpose());
  }
}

void expect_same(const PrincipalComponents& found, const PrincipalComponents& expected) {
  ASSERT_EQ(found.directions.cols(), expected.directions.cols());
  EXPECT_LT((found.mean - expected.mean).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((found.variances - expected.variances).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((found.shares - expected.shares).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((found.directions - expected.directions).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(IncrementalComponents, EqualThoseOfAllPosturesAtOnce) {
  const Eigen::MatrixXd samples = postures(2000, 1);
  IncrementalComponents incremental(kJoints);
  add_all(samples, incremental);
  EXPECT_EQ(incremental.count(), 2000);
  expect_same(incremental.components(), principal_components(samples));
  expect_same(incremental.components({0, 7}), principal_components(samples, {0, 7}));
}

TEST(IncrementalComponents, RefuseWhatIsNoPosture) {
  EXPECT_THROW(IncrementalComponents(0), std::invalid_argument);
  IncrementalComponents components(2);
  EXPECT_THROW(components.add(Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(components.add(Eigen::Vector2d(0, std::numeric_limits<double>::infinity())),
               std::invalid_argument);
  components.add(Eigen::Vector2d::Zero());
  EXPECT_THROW((void)components.components(), geometric::InputError);
}

}  // namespace
}  // namespace handway::sampling
