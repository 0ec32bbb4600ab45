#include "handway/sampling/postures/pmd_basis.h"

#include "handway/sampling/sequences/random_stream.h"
#include "sah_basis.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace handway::sampling {
namespace {

using test::sah_degrees;
using test::sah_published_basis;
using test::sah_thumb_basis;

struct WorkedPosture {
  std::vector<double> controls;  // C1, C2, C3, C4, C8 in [0, 1]
  std::vector<double> degrees;
};

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(PmdBasis, GivesThePublishedJointValues) {
  const std::vector<WorkedPosture> postures = {
      {{.5, .5, .5, .5, .5},
       {-62.505, -5.835, -25.167, -38.485, 1.632, -32.340, -38.968, 0, -30.926, -45.762, -0.273,
        -32.285, -40.877}},
      {{1, .5, .5, .5, .5},
       {-67.592, -7.531, -10.641, -19.719, 7.612, -60.097, -26.483, 0, -62.854, -31.667, -4.595,
        -61.382, -29.732}},
      {{0, .5, .5, .5, .5},
       {-57.418, -4.139, -39.693, -57.250, -4.348, -4.583, -51.452, 0, 1.002, -59.857, 4.049,
        -3.187, -52.023}},
      {{.5, 1, .5, .5, .5},
       {-63.435, -6.145, -32.669, -50.384, 6.132, -43.811, -64.702, 0, -46.570, -69.688, -2.982,
        -47.118, -64.085}},
      {{.5, 0, .5, .5, .5},
       {-61.575, -5.525, -17.665, -26.585, -2.868, -20.869, -13.233, 0, -15.282, -21.836, 2.436,
        -17.451, -17.670}},
      {{.25, .75, .4, .6, .5},
       {-67.573, -7.524, -39.696, -50.657, -0.097, -25.402, -56.920, 0, -22.715, -66.081, 1.116,
        -25.210, -59.494}}};
  const PmdBasis basis = sah_published_basis();
  for (const WorkedPosture& posture : postures) {
    const Eigen::VectorXd degrees = sah_degrees(map_to_posture(basis, vector(posture.controls)));
    // The offsets and vectors are printed with four digits: 79° · 5e-5 · a few terms.
    EXPECT_LT((degrees - vector(posture.degrees)).lpNorm<Eigen::Infinity>(), 0.01)
        << degrees.transpose();
  }
}

TEST(PmdBasis, ReachesTheCornersOfTheBox) {
  const PmdBasis basis = sah_thumb_basis();
  Eigen::VectorXd corner(6);
  corner << 1, 0, 1, 0, 0, 1;
  Eigen::VectorXd expected = basis.mean;
  expected[0] = 0.3055 + 0.5;
  for (std::size_t i = 0; i < 5; ++i) {
    const PrincipalDirection& direction = basis.directions[i];
    const double sign = 2.0 * corner[static_cast<Eigen::Index>(i) + 1] - 1.0;
    expected += sign * direction.half_side * direction.vector;
  }
  expected = expected.cwiseMax(0.0).cwiseMin(1.0);
  EXPECT_LT((map_to_posture(basis, corner) - expected).norm(), 1e-14);
}

TEST(PmdBasis, KeepsEveryJointWithinItsLimits) {
  const PmdBasis basis = sah_thumb_basis();
  for (int bits = 0; bits < 64; ++bits) {
    Eigen::VectorXd corner(6);
    for (int i = 0; i < 6; ++i) {
      corner[i] = (bits >> i) & 1;
    }
    const Eigen::VectorXd posture = map_to_posture(basis, corner);
    EXPECT_GE(posture.minCoeff(), 0.0);
    EXPECT_LE(posture.maxCoeff(), 1.0);
  }
}

TEST(PmdBasis, LeavesAxesBeyondTheSampleAtTheMean) {
  const PmdBasis basis = sah_thumb_basis();
  for (int k = 0; k <= basis.dimension(); ++k) {
    Eigen::VectorXd part = Eigen::VectorXd::Constant(k, 0.7);
    Eigen::VectorXd whole = Eigen::VectorXd::Constant(basis.dimension(), 0.5);
    whole.head(k) = part;
    EXPECT_LT((map_to_posture(basis, part) - map_to_posture(basis, whole)).norm(), 1e-15) << k;
  }
}

TEST(PmdBasis, RefusesMoreCoordinatesThanAxes) {
  EXPECT_THROW(static_cast<void>(map_to_posture(sah_thumb_basis(), Eigen::VectorXd::Zero(7))),
               std::invalid_argument);
}

TEST(PmdBasis, ProjectsAPostureToTheCoordinatesItCameFrom) {
  const PmdBasis basis = sah_thumb_basis();
  Eigen::VectorXd half_sides(6);
  half_sides << 0.5, 1.6550 / 2, 1.4355 / 2, 0.8851 / 2, 0.7174 / 2, 0.3032 / 2;
  RandomStream stream(1);
  for (int n = 0; n < 100; ++n) {
    // The middle third of the box: no joint reaches its limit.
    const Eigen::VectorXd u = (stream.uniform(6).array() - 0.5) / 3.0 + 0.5;
    const Eigen::VectorXd coordinates = (2.0 * u.array() - 1.0) * half_sides.array();
    const Eigen::VectorXd posture = map_to_posture(basis, u);
    EXPECT_LT((project(basis, posture) - coordinates).norm(), 1e-12);
    EXPECT_LT(distance_to_subspace(basis, posture), 1e-12);
  }
}

TEST(PmdBasis, MeasuresTheDistanceOfPosturesOutsideTheSubspace) {
  const PmdBasis basis = sah_thumb_basis();
  Eigen::VectorXd posture = map_to_posture(basis, Eigen::VectorXd::Constant(6, 0.5));
  posture[7] += 0.25;  // the middle finger's spread: no direction moves it
  EXPECT_NEAR(distance_to_subspace(basis, posture), 0.25, 1e-12);
}

TEST(PmdBasis, SpansEveryJointInTheFullBasis) {
  const PmdBasis basis = full_joint_basis("hand", {"a", "b", "c"});
  EXPECT_EQ(basis.dimension(), 3);
  const Eigen::Vector3d u(0.0, 0.3, 1.0);
  EXPECT_LT((map_to_posture(basis, u) - u).norm(), 1e-15);
  EXPECT_NEAR(distance_to_subspace(basis, u), 0.0, 1e-14);
}

}  // namespace
}  // namespace handway::sampling
