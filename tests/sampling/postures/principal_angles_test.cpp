#include "handway/sampling/postures/pmd_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace handway::sampling {
namespace {

TEST(PrincipalAngles, AreNoneBetweenBasesOfTheSameSpace) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 2);
  Eigen::MatrixXd b(4, 2);
  b << c, -s, s, c, 0, 0, 0, 0;
  EXPECT_LT(principal_angles(a, b).maxCoeff(), 1e-15);
}

TEST(PrincipalAngles, TellHowFarPlanesAreApart) {
  Eigen::MatrixXd a(4, 2);
  Eigen::MatrixXd b(4, 2);
  a << 1, 0, 0, 1, 0, 0, 0, 0;
  b << std::cos(0.3), 0, 0, std::cos(1.2), std::sin(0.3), 0, 0, std::sin(1.2);
  const Eigen::VectorXd angles = principal_angles(a, b);
  EXPECT_NEAR(angles[0], 0.3, 1e-14);
  EXPECT_NEAR(angles[1], 1.2, 1e-14);
}

TEST(PrincipalAngles, AreExactWhereTheyAreSmall) {
  Eigen::MatrixXd a(3, 1);
  Eigen::MatrixXd b(3, 1);
  a << 1, 0, 0;
  b << std::cos(1e-9), std::sin(1e-9), 0;
  EXPECT_NEAR(principal_angles(a, b)[0], 1e-9, 1e-22);
}

TEST(PrincipalAngles, AreAsManyAsTheNarrowerBasisHas) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(4, 4);
  EXPECT_EQ(principal_angles(identity.leftCols(3), identity.rightCols(2)).size(), 2);
  EXPECT_NEAR(principal_angles(identity.leftCols(3), identity.rightCols(2))[1],
              std::numbers::pi / 2, 1e-15);
  EXPECT_THROW((void)principal_angles(identity, Eigen::MatrixXd::Identity(3, 2)),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
