#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"
#include "handway/sampling/sequences/random_stream.h"
#include "sah_basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace handway::sampling {
namespace {

using test::sah_thumb_basis;
using ::testing::HasSubstr;

PostureTable random_postures(const PmdBasis& basis, int count) {
  RandomStream draw(7);
  PostureTable table{basis.hand, "drawn", basis.joints, {}};
  table.postures.resize(count, static_cast<Eigen::Index>(basis.joints.size()));
  for (auto row : table.postures.rowwise()) {
    row = map_to_posture(basis, draw.uniform(basis.dimension())).transpose();
  }
  return table;
}

// Returns the distance that the search must find, by linear search.
double least_distance(const PmdBasis& basis, const PostureTable& table,
                      const Eigen::VectorXd& posture) {
  Eigen::MatrixXd apart = table.postures.rowwise() - posture.transpose();
  for (const FreeJoint& free : basis.free_joints) {
    apart.col(free.joint).setZero();
  }
  return apart.rowwise().norm().minCoeff();
}

TEST(RecordedPostures, FindsTheNearestOfAll) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureTable table = random_postures(basis, 500);
  const RecordedPostures recorded(basis, table, "drawn");
  EXPECT_EQ(recorded.count(), 500);
  RandomStream draw(8);
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd posture = draw.uniform(static_cast<int>(basis.joints.size()));
    const NearestPosture nearest = recorded.nearest(posture);
    EXPECT_NEAR(nearest.distance, least_distance(basis, table, posture), 1e-12);
    EXPECT_NEAR((nearest.joints - posture).norm(), nearest.distance, 1e-12);
  }
}

TEST(RecordedPostures, LiesAtDistanceZeroOfItself) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureTable table = random_postures(basis, 20);
  const RecordedPostures recorded(basis, table, "drawn");
  for (const auto& row : table.postures.rowwise()) {
    EXPECT_NEAR(recorded.nearest(row.transpose()).distance, 0.0, 1e-15);
  }
}

TEST(RecordedPostures, LetsFreeJointsGoTheirOwnWay) {
  const PmdBasis basis = sah_thumb_basis();
  const PostureTable table = random_postures(basis, 20);
  const RecordedPostures recorded(basis, table, "drawn");
  Eigen::VectorXd posture = table.postures.row(3).transpose();
  posture[basis.free_joints[0].joint] = 0.987;
  const NearestPosture nearest = recorded.nearest(posture);
  EXPECT_NEAR(nearest.distance, 0.0, 1e-15);
  EXPECT_EQ(nearest.joints[basis.free_joints[0].joint], 0.987);
}

TEST(RecordedPostures, TakesColumnsInAnyOrder) {
  const PmdBasis basis = sah_thumb_basis();
  PostureTable table = random_postures(basis, 20);
  const Eigen::VectorXd posture = table.postures.row(5).transpose();
  std::swap(table.joints[1], table.joints[9]);
  table.postures.col(1).swap(table.postures.col(9));
  EXPECT_NEAR(RecordedPostures(basis, table, "drawn").nearest(posture).distance, 0.0, 1e-15);
}

TEST(RecordedPostures, KnowHowFarTheyStrayFromTheBasis) {
  const PmdBasis basis = sah_thumb_basis();
  PostureTable table = random_postures(basis, 101);
  table.postures.col(7).setConstant(basis.mean[7]);
  // One posture in ten strays by 0.2.
  for (Eigen::Index row = 0; row < table.postures.rows(); row += 10) {
    table.postures(row, 7) += 0.2;
  }
  const RecordedPostures recorded(basis, table, "drawn");
  EXPECT_NEAR(recorded.usual_distance_to_subspace(), 0.2, 0.1);
}

TEST(RecordedPostures, MustBeOfTheSameHand) {
  const PmdBasis basis = sah_thumb_basis();
  PostureTable table = random_postures(basis, 3);
  table.hand = "claw";
  try {
    RecordedPostures(basis, table, "claw.csv");
    FAIL() << "took another hand's postures";
  } catch (const geometric::InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("claw.csv: hand: found \"claw\", expected \"sah_right\""));
  }
  table = random_postures(basis, 3);
  table.joints[4] = "wing";
  EXPECT_THROW(RecordedPostures(basis, table, "claw.csv"), geometric::InputError);
}

TEST(RecordedPostures, AreNoneForABasisThatKeptNone) {
  EXPECT_EQ(load_recorded_postures(sah_thumb_basis()), nullptr);
}

TEST(RecordedPostures, ComeWithTheBasisThatShips) {
  const PmdBasis basis = read_pmd_basis(geometric::resource_dir() / "bases" / "sah_free_hand.yaml");
  const auto recorded = load_recorded_postures(basis);
  ASSERT_NE(recorded, nullptr);
  EXPECT_GT(recorded->count(), 1000);
  EXPECT_THAT(recorded->source(), HasSubstr("free_hand.csv"));
  EXPECT_GT(recorded->usual_distance_to_subspace(), 0.01);
  EXPECT_LT(recorded->usual_distance_to_subspace(), 0.6);
  EXPECT_LT(recorded->nearest(basis.mean).distance, 0.5);
}

// Postures that move from the first to the second drawn posture and back, with rests between.
PostureTable back_and_forth(const PmdBasis& basis, int times) {
  constexpr Eigen::Index kRest = 50;
  const PostureTable ends = random_postures(basis, 2);
  PostureTable table = ends;
  table.postures.resize(2 * kRest * times, ends.postures.cols());
  table.times.resize(table.postures.rows());
  for (Eigen::Index row = 0; row < table.times.size(); ++row) {
    const auto step = static_cast<double>(row % (2 * kRest)) / static_cast<double>(kRest);
    const double smooth = 0.5 - 0.5 * std::cos(std::numbers::pi * std::fmin(step, 1.0));
    const Eigen::Index from = row / (2 * kRest) % 2;
    table.times[row] = 0.01 * static_cast<double>(row);
    table.postures.row(row) =
        (1.0 - smooth) * ends.postures.row(from) + smooth * ends.postures.row(1 - from);
  }
  return table;
}

TEST(RecordedPostures, HaveComponentsOfTheirMotions) {
  const PmdBasis basis = sah_thumb_basis();
  const RecordedPostures recorded(basis, back_and_forth(basis, 12), "made up");
  ASSERT_NE(recorded.motions(), nullptr) << recorded.motions_fault();
  EXPECT_EQ(recorded.motions()->motions(), 12U);
  EXPECT_EQ(recorded.motions()->count(), 1) << "they all have the same course";
  for (const int joint : recorded.motions()->joints()) {
    EXPECT_NE(joint, basis.free_joints.front().joint) << "free joints don't count";
  }
  EXPECT_EQ(recorded.motions_fault(), "");
}

TEST(RecordedPostures, SayThatMotionsAreTooFew) {
  const PmdBasis basis = sah_thumb_basis();
  const RecordedPostures recorded(basis, back_and_forth(basis, 9), "made up");
  EXPECT_EQ(recorded.motions(), nullptr);
  EXPECT_EQ(recorded.motions_fault(),
            "The recording has 9 motions, which are too few: at least 10 are needed. Record for "
            "longer, or with pauses between motions.");
}

TEST(RecordedPostures, SayThatTimesAreMissing) {
  const PmdBasis basis = sah_thumb_basis();
  const RecordedPostures recorded(basis, random_postures(basis, 100), "drawn");
  EXPECT_EQ(recorded.motions(), nullptr);
  EXPECT_EQ(recorded.motions_fault(),
            "The recorded postures have no times, so that no motions can be cut from them.");
}

TEST(RecordedPostures, OfTheShippedBasisHaveManyMotions) {
  const auto recorded = load_recorded_postures(
      read_pmd_basis(geometric::resource_dir() / "bases" / "sah_free_hand.yaml"));
  ASSERT_NE(recorded->motions(), nullptr);
  EXPECT_GT(recorded->motions()->motions(), 100U);
  EXPECT_THAT(recorded->source(), HasSubstr("a synthetic hand"));
}

}  // namespace
}  // namespace handway::sampling
