#include "handway/sampling/postures/principal_components.h"

#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/sequences/random_stream.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

const Eigen::Vector3d kMean(0.4, 0.5, 0.6);

// Orthonormal columns.
Eigen::Matrix3d directions() {
  Eigen::Matrix3d V;
  V << 2, -2, 1, 1, 2, 2, 2, 1, -2;
  return V / 3.0;
}

// mean ± a_k v_k: the variance along v_k is 2 a_k² / 5.
Eigen::MatrixXd six_samples(const Eigen::Vector3d& amplitudes) {
  Eigen::MatrixXd samples(6, 3);
  for (int k = 0; k < 3; ++k) {
    samples.row(2 * k) = kMean + amplitudes[k] * directions().col(k);
    samples.row(2 * k + 1) = kMean - amplitudes[k] * directions().col(k);
  }
  return samples;
}

const std::vector<std::string> kJointNames = {"a", "b", "c"};

TEST(PrincipalComponents, RecoversKnownDirectionsAndVariances) {
  const Eigen::Vector3d amplitudes(0.3, 0.2, 0.1);
  const PrincipalComponents found = principal_components(six_samples(amplitudes));
  EXPECT_LT((found.mean - kMean).norm(), 1e-15);
  EXPECT_LT((found.variances - 0.4 * amplitudes.cwiseAbs2()).norm(), 1e-15);
  EXPECT_LT((found.shares - Eigen::Vector3d(9, 4, 1) / 14.0).norm(), 1e-14);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::abs(found.directions.col(k).dot(directions().col(k))), 1.0, 1e-14);
    EXPECT_GT(found.directions.col(k).maxCoeff(), -found.directions.col(k).minCoeff() - 1e-12);
  }
}

TEST(PrincipalComponents, OrdersByFallingVariance) {
  const PrincipalComponents found = principal_components(six_samples({0.1, 0.3, 0.2}));
  EXPECT_NEAR(std::abs(found.directions.col(0).dot(directions().col(1))), 1.0, 1e-14);
  EXPECT_GE(found.variances[0], found.variances[1]);
  EXPECT_GE(found.variances[1], found.variances[2]);
}

TEST(PrincipalComponents, DiagonalisesTheCovariance) {
  RandomStream stream(1);
  Eigen::MatrixXd mixing(5, 5);
  for (double& entry : mixing.reshaped()) {
    entry = 0.1 * stream.normal();
  }
  Eigen::MatrixXd samples(300, 5);
  for (Eigen::Index i = 0; i < samples.rows(); ++i) {
    samples.row(i) = mixing * stream.normal(5);
  }
  const PrincipalComponents found = principal_components(samples);
  const Eigen::MatrixXd centred = samples.rowwise() - samples.colwise().mean();
  const Eigen::MatrixXd covariance = centred.transpose() * centred / 299.0;
  const Eigen::MatrixXd rebuilt =
      found.directions * found.variances.asDiagonal() * found.directions.transpose();
  EXPECT_LT((rebuilt - covariance).norm(), 1e-14);
  EXPECT_TRUE((found.directions.transpose() * found.directions).isIdentity(1e-13));
  EXPECT_NEAR(found.shares.sum(), 1.0, 1e-14);
}

TEST(PrincipalComponents, LeavesJointsOut) {
  Eigen::MatrixXd samples = six_samples({0.3, 0.2, 0.1});
  const PrincipalComponents found = principal_components(samples, {1});
  ASSERT_EQ(found.directions.rows(), 3);
  ASSERT_EQ(found.directions.cols(), 2);
  EXPECT_EQ(found.directions.row(1).norm(), 0.0);
  EXPECT_NEAR(found.mean[1], 0.5, 1e-15);
  const double variance_of_others = ((samples.col(0).array() - 0.4).square().sum() +
                                     (samples.col(2).array() - 0.6).square().sum()) /
                                    5.0;
  EXPECT_NEAR(found.variances.sum(), variance_of_others, 1e-15);
  EXPECT_NEAR(found.shares.sum(), 1.0, 1e-14);
}

TEST(PrincipalComponents, FindsNoMoreComponentsThanSamples) {
  const PrincipalComponents found = principal_components(six_samples({0.3, 0.2, 0.1}).topRows(2));
  EXPECT_EQ(found.variances.size(), 2);
  EXPECT_NEAR(found.shares[0], 1.0, 1e-14);
}

TEST(PrincipalComponents, CopesWithPosturesThatNeverChange) {
  const Eigen::MatrixXd samples = Eigen::MatrixXd::Constant(4, 3, 0.25);
  const PrincipalComponents found = principal_components(samples);
  EXPECT_EQ(found.shares, Eigen::Vector3d::Zero());
  EXPECT_TRUE(make_pmd_basis("hand", "", kJointNames, found).directions.empty());
}

TEST(PrincipalComponents, RefusesTooFewOrUnusableSamples) {
  EXPECT_THROW(static_cast<void>(principal_components(Eigen::MatrixXd::Zero(1, 3))),
               geometric::InputError);
  Eigen::MatrixXd samples = six_samples({0.3, 0.2, 0.1});
  samples(3, 1) = std::numeric_limits<double>::quiet_NaN();
  try {
    static_cast<void>(principal_components(samples));
    FAIL() << "took a sample that isn't a number";
  } catch (const geometric::InputError& e) {
    EXPECT_EQ(e.problem().element, "sample 4");
  }
}

TEST(PrincipalComponents, RefusesUnknownJointsToLeaveOut) {
  const Eigen::MatrixXd samples = six_samples({0.3, 0.2, 0.1});
  EXPECT_THROW(static_cast<void>(principal_components(samples, {3})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(principal_components(samples, {1, 1})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(principal_components(samples, {0, 1, 2})), std::invalid_argument);
}

TEST(MakePmdBasis, GivesHalfSidesInStandardDeviations) {
  const Eigen::Vector3d amplitudes(0.3, 0.2, 0.1);
  const PrincipalComponents components = principal_components(six_samples(amplitudes));
  const PmdBasis basis = make_pmd_basis("hand", "made up", kJointNames, components, {{}, 2, 1.5});
  EXPECT_EQ(basis.hand, "hand");
  EXPECT_EQ(basis.source, "made up");
  EXPECT_EQ(basis.joints, kJointNames);
  EXPECT_EQ(basis.dimension(), 2);
  EXPECT_EQ(basis.directions[0].name, "PMD1");
  EXPECT_EQ(basis.directions[1].name, "PMD2");
  EXPECT_NEAR(basis.directions[0].half_side, 1.5 * std::sqrt(0.4) * 0.3, 1e-14);
  EXPECT_NEAR(basis.directions[1].half_side, 1.5 * std::sqrt(0.4) * 0.2, 1e-14);
  EXPECT_NEAR(basis.directions[1].variance, 0.016, 1e-15);
}

TEST(MakePmdBasis, PutsFreeJointsFirstOverTheirWholeRange) {
  const PrincipalComponents components = principal_components(six_samples({0.3, 0.2, 0.1}), {1});
  const PmdBasis basis = make_pmd_basis("hand", "", kJointNames, components, {{1}, 4, 1.5});
  ASSERT_EQ(basis.dimension(), 3);
  const Eigen::Vector3d low = map_to_posture(basis, Eigen::VectorXd::Zero(1));
  EXPECT_LT((low - Eigen::Vector3d(0.4, 0.0, 0.6)).norm(), 1e-14);
  const Eigen::Vector3d high = map_to_posture(basis, Eigen::VectorXd::Ones(1));
  EXPECT_LT((high - Eigen::Vector3d(0.4, 1.0, 0.6)).norm(), 1e-14);
}

TEST(MakePmdBasis, SpansTheDataItCameFrom) {
  const Eigen::MatrixXd samples = six_samples({0.3, 0.2, 0.0});
  const PmdBasis basis = make_pmd_basis("hand", "", kJointNames, principal_components(samples));
  EXPECT_EQ(basis.dimension(), 2);  // the third direction doesn't vary
  for (Eigen::Index i = 0; i < samples.rows(); ++i) {
    EXPECT_LT(distance_to_subspace(basis, samples.row(i)), 1e-14);
  }
}

TEST(MakePmdBasis, MakesBasesThatFilesCanHold) {
  const test::ScratchFolder folder;
  const PmdBasis basis =
      make_pmd_basis("hand", "", kJointNames,
                     principal_components(six_samples({0.3, 0.2, 0.1}), {0}), {{0}, 4, 1.5});
  write_pmd_basis(basis, folder.path() / "basis.yaml");
  const PmdBasis read = read_pmd_basis(folder.path() / "basis.yaml");
  EXPECT_EQ(read.directions.at(1).vector, basis.directions.at(1).vector);
}

TEST(MakePmdBasis, RefusesWrongArguments) {
  const PrincipalComponents components = principal_components(six_samples({0.3, 0.2, 0.1}));
  const auto make = [&](std::vector<std::string> joints, const PmdBasisOptions& options) {
    static_cast<void>(make_pmd_basis("hand", "", std::move(joints), components, options));
  };
  EXPECT_THROW(make({"a"}, {}), std::invalid_argument);
  EXPECT_THROW(make(kJointNames, {{}, -1, 1.5}), std::invalid_argument);
  EXPECT_THROW(make(kJointNames, {{}, 2, 0.0}), std::invalid_argument);
  EXPECT_THROW(make(kJointNames, {{3}, 2, 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
