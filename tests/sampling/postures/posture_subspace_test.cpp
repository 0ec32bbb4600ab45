#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/sequences/random_stream.h"
#include "sah_basis.h"

#include <gtest/gtest.h>

namespace handway::sampling {
namespace {

using test::sah_thumb_basis;

TEST(PostureSubspace, AgreesWithTheDistanceOfASinglePosture) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureSubspace subspace(basis);
  RandomStream draw(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd posture = draw.uniform(static_cast<int>(basis.joints.size()));
    EXPECT_NEAR(subspace.distance(posture), distance_to_subspace(basis, posture), 1e-12);
  }
}

TEST(PostureSubspace, HoldsEveryPostureOfTheBasis) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureSubspace subspace(basis);
  const Eigen::VectorXd posture =
      map_to_posture(basis, Eigen::VectorXd::Constant(basis.dimension(), 0.5));
  EXPECT_LT(subspace.distance(posture), 1e-12);
  EXPECT_LT((subspace.closest(posture) - posture).norm(), 1e-12);
}

TEST(PostureSubspace, TakesBackWhatNoDirectionMoves) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureSubspace subspace(basis);
  const Eigen::VectorXd human =
      map_to_posture(basis, Eigen::VectorXd::Constant(basis.dimension(), 0.5));
  Eigen::VectorXd posture = human;
  posture[7] += 0.25;  // the middle finger's spread
  EXPECT_NEAR(subspace.distance(posture), 0.25, 1e-12);
  EXPECT_LT((subspace.closest(posture) - human).norm(), 1e-12);
}

TEST(PostureSubspace, KeepsJointsWithinTheirLimits) {
  const PmdBasis basis = sah_thumb_basis();
  const Eigen::VectorXd closest =
      PostureSubspace(basis).closest(Eigen::VectorXd::Constant(basis.mean.size(), 1.0));
  EXPECT_GE(closest.minCoeff(), 0.0);
  EXPECT_LE(closest.maxCoeff(), 1.0);
}

TEST(PostureSubspace, IsEverythingWithTheFullBasis) {
  const PostureSubspace subspace(full_joint_basis("hand", {"a", "b", "c"}));
  EXPECT_NEAR(subspace.distance(Eigen::Vector3d(0.0, 0.3, 1.0)), 0.0, 1e-14);
}

}  // namespace
}  // namespace handway::sampling
