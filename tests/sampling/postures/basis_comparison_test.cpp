#include "handway/sampling/postures/basis_study.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway_test/input_errors.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace handway::sampling {
namespace {

const std::vector<std::string> kThreeJoints{"a", "b", "c"};

/// Postures that vary along one direction, and by so much across it.
PostureTable postures_along(const Eigen::Vector3d& direction, double across) {
  PostureTable table{"hand", "", kThreeJoints, Eigen::MatrixXd(101, 3)};
  for (Eigen::Index row = 0; row < 101; ++row) {
    const double t = 0.01 * static_cast<double>(row) - 0.5;
    const Eigen::Vector3d aside = direction.unitOrthogonal() * (row % 2 == 0 ? across : -across);
    table.postures.row(row) =
        (Eigen::Vector3d::Constant(0.5) + 0.4 * t * direction + aside).transpose();
  }
  return table;
}

PmdBasis one_direction(const PostureTable& table) {
  return make_pmd_basis(table.hand, "", table.joints, principal_components(table.postures),
                        {{}, 1, 1.5});
}

TEST(BasisComparison, FindsTheAngleBetweenDirections) {
  const PmdBasis a = one_direction(postures_along({1.0, 0.0, 0.0}, 0.0));
  const PmdBasis b = one_direction(postures_along({std::cos(0.3), std::sin(0.3), 0.0}, 0.0));
  const Eigen::VectorXd angles = angles_between(a, b);
  ASSERT_EQ(angles.size(), 1);
  EXPECT_NEAR(angles[0], 0.3, 1e-9);
  EXPECT_NEAR(angles_between(a, a)[0], 0.0, 1e-9);
}

TEST(BasisComparison, GoesByTheNamesOfJoints) {
  const PostureTable table = postures_along({1.0, 0.0, 0.0}, 0.0);
  PostureTable turned{"hand", "", {"c", "b", "a"}, table.postures.rowwise().reverse()};
  EXPECT_NEAR(angles_between(one_direction(table), one_direction(turned))[0], 0.0, 1e-9);
  EXPECT_NEAR(reconstruct(one_direction(table), turned).held, 1.0, 1e-9);
}

TEST(BasisComparison, SaysWhatABasisMissesOfPostures) {
  const PostureTable table = postures_along({1.0, 0.0, 0.0}, 0.05);
  const Reconstruction own = reconstruct(one_direction(table), table);
  EXPECT_NEAR(own.rms.norm(), 0.05, 1e-3);
  EXPECT_GT(own.held, 0.8);
  const Reconstruction other =
      reconstruct(one_direction(postures_along({0.0, 0.0, 1.0}, 0.0)), table);
  EXPECT_LT(other.held, 0.2);
  EXPECT_NEAR(other.rms[2], 0.0, 0.051);
  EXPECT_GT(other.rms[0], 0.1);
}

TEST(BasisComparison, RefusesTheBasisOfAnotherHand) {
  const PostureTable table = postures_along({1.0, 0.0, 0.0}, 0.0);
  PostureTable other = table;
  other.joints[2] = "d";
  EXPECT_THROW((void)angles_between(one_direction(table), one_direction(other)),
               geometric::InputError);
  EXPECT_THROW((void)reconstruct(one_direction(table), other), geometric::InputError);
}

}  // namespace
}  // namespace handway::sampling
