#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

namespace handway::sampling {
namespace {

// Flat normal postures, of which every tenth is far off in one direction.
Eigen::MatrixXd postures(bool with_outliers) {
  RandomStream stream(3);
  const Eigen::Vector4d sigmas(0.2, 0.1, 0.03, 0.02);
  Eigen::MatrixXd samples(1000, 4);
  for (Eigen::Index row = 0; row < samples.rows(); ++row) {
    samples.row(row) = (sigmas.cwiseProduct(stream.normal(4)).array() + 0.5).transpose();
    if (with_outliers && row % 10 == 0) {
      samples.row(row) = Eigen::RowVector4d(0.5, 0.5, 0.5, 3.0);
    }
  }
  return samples;
}

TEST(RobustComponents, AreNotTurnedByOutliers) {
  const Eigen::MatrixXd wild = postures(true);
  const RobustComponents robust = robust_principal_components(wild);
  const PrincipalComponents clean = principal_components(postures(false));
  EXPECT_LT(principal_angles(robust.components.directions.leftCols(2), clean.directions.leftCols(2))
                .maxCoeff(),
            0.05);
  EXPECT_GT(principal_angles(principal_components(wild).directions.leftCols(1),
                             clean.directions.leftCols(1))
                .maxCoeff(),
            1.0);
  for (Eigen::Index row = 0; row < wild.rows(); row += 10) {
    EXPECT_FALSE(robust.kept[static_cast<std::size_t>(row)]);
  }
  EXPECT_LT(robust.outliers, 160);
}

TEST(RobustComponents, KeepNearlyAllOfCleanSamples) {
  const RobustComponents robust = robust_principal_components(postures(false));
  EXPECT_LT(robust.outliers, 60);
}

TEST(RobustComponents, LiveWithJointsThatDoNotMoveOrMoveTogether) {
  Eigen::MatrixXd samples(1000, 6);
  samples.leftCols(4) = postures(true);
  samples.col(4).setConstant(0.5);
  samples.col(5) = samples.col(0);
  const RobustComponents robust = robust_principal_components(samples, {5});
  EXPECT_EQ(robust.components.directions.row(5).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_FALSE(robust.kept[0]);
  EXPECT_TRUE(robust_principal_components(Eigen::MatrixXd::Constant(5, 3, 0.5)).kept[4]);
}

}  // namespace
}  // namespace handway::sampling
