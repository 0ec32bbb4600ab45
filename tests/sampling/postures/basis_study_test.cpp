#include "handway/sampling/postures/basis_study.h"

#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>

namespace handway::sampling {
namespace {

constexpr int kHandJoints = 6;
constexpr double kRate = 20.0;  // Hz

/// Postures that change slowly along two directions, the first of them at `angle` in a plane, with
/// noise in all joints.
RecordedHand hand(const std::string& name, std::uint64_t seed, double seconds, double angle = 0.0) {
  RandomStream random(seed);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(kHandJoints, 2);
  directions.col(0) << std::cos(angle), std::sin(angle), 0.0, 0.0, 0.0, 0.0;
  directions(3, 1) = 1.0;
  RecordedHand result{name, Eigen::MatrixXd(std::lround(seconds * kRate), kHandJoints), kRate};
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (Eigen::Index row = 0; row < result.samples.rows(); ++row) {
    at = 0.95 * at + Eigen::Vector2d(0.05 * random.normal(), 0.03 * random.normal());
    const Eigen::VectorXd posture = Eigen::VectorXd::Constant(kHandJoints, 0.5) + directions * at +
                                    0.002 * random.normal(kHandJoints);
    result.samples.row(row) = posture.transpose();
  }
  return result;
}

/// Returns the positions of two fingertips, which move by 0.1 m per joint and range.
Eigen::Matrix3Xd fingertips(const Eigen::VectorXd& posture) {
  Eigen::Matrix3Xd tips(3, 2);
  tips.col(0) = 0.1 * posture.head<3>();
  tips.col(1) = 0.1 * posture.tail<3>();
  return tips;
}

TEST(BasisStudy, FindsHowManyDirectionsAreEnough) {
  const BasisStudy study = study_basis({hand("a", 1, 60.0)}, fingertips);
  ASSERT_EQ(study.reconstruction.size(), 7U);
  for (std::size_t k = 1; k < study.reconstruction.size(); ++k) {
    EXPECT_LT(study.reconstruction[k].fingertip.mean, study.reconstruction[k - 1].fingertip.mean);
  }
  for (const ReconstructionError& error : study.reconstruction) {
    EXPECT_LE(error.fingertip.low, error.fingertip.mean);
    EXPECT_LE(error.fingertip.mean, error.fingertip.high);
    EXPECT_GE(error.most, error.fingertip.mean);
  }
  EXPECT_NEAR(study.reconstruction.back().fingertip.mean, 0.0, 1e-9);
  EXPECT_GT(study.reconstruction[2].variance, 0.98);
  EXPECT_EQ(study.enough_for(0.0005), 2);
  EXPECT_EQ(study.enough_for(1.0), 0);
  EXPECT_EQ(study.enough_for(-1.0), -1);
  EXPECT_TRUE(study.persons.empty());
}

TEST(BasisStudy, FindsTheBasisSteadierTheLongerTheRecording) {
  const BasisStudy study = study_basis({hand("a", 1, 120.0)}, fingertips);
  ASSERT_EQ(study.stability.size(), 5U);
  EXPECT_NEAR(study.stability.back().seconds, 120.0, 1e-9);
  for (std::size_t i = 1; i < study.stability.size(); ++i) {
    EXPECT_GT(study.stability[i].seconds, 1.9 * study.stability[i - 1].seconds);
  }
  const auto angle = [&](std::size_t length, std::size_t directions) {
    return study.stability[length].angles[directions - 1].mean;
  };
  EXPECT_LT(angle(4, 2), 0.5 * angle(0, 2));
  EXPECT_LT(angle(4, 2), 0.05) << "two directions there are";
  EXPECT_GT(angle(4, 3), angle(4, 2)) << "the third is noise";
}

TEST(BasisStudy, ComparesPersons) {
  BasisStudySettings settings;
  settings.directions = 2;
  const BasisStudy alike =
      study_basis({hand("a", 1, 60.0), hand("b", 2, 60.0)}, fingertips, settings);
  ASSERT_EQ(alike.persons.size(), 2U);
  EXPECT_EQ(alike.persons[1].name, "b");
  EXPECT_LT(alike.persons[1].angles[1], 0.05);
  EXPECT_LT(alike.newcomer.mean, 1.1 * alike.persons[0].own.mean);
  const BasisStudy different =
      study_basis({hand("a", 1, 60.0), hand("b", 2, 60.0, 1.2)}, fingertips, settings);
  EXPECT_NEAR(different.persons[1].angles[1], 1.2, 0.05);
  EXPECT_GT(different.newcomer.mean, 5.0 * different.persons[0].own.mean);
}

TEST(BasisStudy, KeepsWhatFreeJointsDo) {
  BasisStudySettings settings;
  settings.free_joints = {0};
  const BasisStudy study = study_basis({hand("a", 1, 60.0)}, fingertips, settings);
  EXPECT_EQ(study.reconstruction.size(), 6U);
  EXPECT_EQ(study.enough_for(0.0005), 1) << "the other direction is the free joint's";
}

TEST(BasisStudy, FindsTheSameForTheSameSeed) {
  const std::vector<RecordedHand> hands{hand("a", 1, 20.0), hand("b", 2, 20.0, 0.3)};
  BasisStudySettings settings;
  settings.resamples = 50;
  const BasisStudy one = study_basis(hands, fingertips, settings);
  const BasisStudy two = study_basis(hands, fingertips, settings);
  EXPECT_EQ(one.reconstruction[1].fingertip.high, two.reconstruction[1].fingertip.high);
  EXPECT_EQ(one.stability[0].angles[1].low, two.stability[0].angles[1].low);
  EXPECT_EQ(one.newcomer.low, two.newcomer.low);
  settings.seed = 2;
  EXPECT_NE(study_basis(hands, fingertips, settings).reconstruction[1].fingertip.high,
            one.reconstruction[1].fingertip.high);
}

TEST(BasisStudy, NeedsMoreThanOneBlockOfEachRecording) {
  EXPECT_THROW(static_cast<void>(study_basis({hand("a", 1, 1.5)}, fingertips)),
               geometric::InputError);
}

TEST(IncrementalComponents, AreMergedAsIfTheyHadSeenAll) {
  const Eigen::MatrixXd samples = hand("a", 1, 10.0).samples;
  IncrementalComponents first(kHandJoints);
  IncrementalComponents rest(kHandJoints);
  for (Eigen::Index row = 0; row < samples.rows(); ++row) {
    (row < 30 ? first : rest).add(samples.row(row).transpose());
  }
  IncrementalComponents both(kHandJoints);
  both.add(first);
  both.add(rest);
  EXPECT_EQ(both.count(), samples.rows());
  EXPECT_TRUE(both.components().variances.isApprox(principal_components(samples).variances, 1e-9));
  EXPECT_TRUE(both.components().directions.leftCols(2).isApprox(
      principal_components(samples).directions.leftCols(2), 1e-6));
}

}  // namespace
}  // namespace handway::sampling
