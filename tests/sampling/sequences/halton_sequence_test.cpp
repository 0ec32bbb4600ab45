#include "handway/sampling/sequences/halton_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

TEST(HaltonSequence, ComputesAsManyPrimesAsAsked) {
  EXPECT_EQ(first_primes(6), (std::vector<std::uint32_t>{2, 3, 5, 7, 11, 13}));
  EXPECT_EQ(first_primes(100).back(), 541u);
  EXPECT_TRUE(first_primes(0).empty());
  EXPECT_THROW(static_cast<void>(first_primes(-1)), std::invalid_argument);
}

TEST(HaltonSequence, StartsWithTheKnownPoints) {
  const HaltonSequence sequence(3);
  EXPECT_LT((sequence.point(0) - Eigen::Vector3d(1 / 2.0, 1 / 3.0, 1 / 5.0)).norm(), 1e-15);
  EXPECT_LT((sequence.point(1) - Eigen::Vector3d(1 / 4.0, 2 / 3.0, 2 / 5.0)).norm(), 1e-15);
  EXPECT_LT((sequence.point(5) - Eigen::Vector3d(3 / 8.0, 2 / 9.0, 6 / 25.0)).norm(), 1e-15);
}

// Any 2^a 3^b successive elements have one point in every box of the grid with
// 2^a by 3^b cells.
int boxes_hit(const HaltonSequence& sequence, std::uint64_t first) {
  std::set<std::pair<int, int>> boxes;
  for (std::uint64_t i = first; i < first + 8 * 9; ++i) {
    const Eigen::VectorXd point = sequence.point(i);
    boxes.emplace(static_cast<int>(point[0] * 8.0), static_cast<int>(point[1] * 9.0 + 1e-12));
  }
  return static_cast<int>(boxes.size());
}

TEST(HaltonSequence, HitsEveryElementaryIntervalEquallyOften) {
  for (const std::uint64_t first : {0u, 17u, 100000u}) {
    EXPECT_EQ(boxes_hit(HaltonSequence(2), first), 72);
    EXPECT_EQ(boxes_hit(HaltonSequence(2, {1, 99}), first), 72);
    EXPECT_EQ(boxes_hit(HaltonSequence(2, {409, std::nullopt}), first), 72);
  }
}

TEST(HaltonSequence, TakesEveryLeapthElement) {
  const HaltonSequence plain(4);
  const HaltonSequence leaped(4, {31, std::nullopt});
  for (std::uint64_t i = 0; i < 20; ++i) {
    EXPECT_EQ(leaped.point(i), plain.point(31 * (i + 1) - 1));
  }
}

TEST(HaltonSequence, RefusesLeapsThatShareAFactorWithABase) {
  EXPECT_THROW(HaltonSequence(3, {10, std::nullopt}), std::invalid_argument);
  EXPECT_THROW(HaltonSequence(1, {0, std::nullopt}), std::invalid_argument);
  EXPECT_NO_THROW(HaltonSequence(3, {7, std::nullopt}));
  EXPECT_THROW(HaltonSequence(0), std::invalid_argument);
}

TEST(HaltonSequence, BreaksTheLinesOfManyDimensionsByScrambling) {
  constexpr int kPoints = 60;  // below the bases 71 and 73 of the last two axes
  const auto correlation = [&](const HaltonSequence& sequence) {
    Eigen::MatrixXd points(kPoints, 2);
    for (int i = 0; i < kPoints; ++i) {
      points.row(i) = sequence.point(static_cast<std::uint64_t>(i)).tail(2);
    }
    const Eigen::MatrixXd centred = points.rowwise() - points.colwise().mean();
    return centred.col(0).dot(centred.col(1)) / (centred.col(0).norm() * centred.col(1).norm());
  };
  EXPECT_GT(correlation(HaltonSequence(21)), 0.99);
  EXPECT_LT(std::abs(correlation(HaltonSequence(21, {1, 5}))), 0.4);
}

TEST(HaltonSequence, WorksInManyDimensions) {
  const HaltonSequence sequence(200, {1, 3});
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(200);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Eigen::VectorXd point = sequence.point(i);
    ASSERT_GE(point.minCoeff(), 0.0);
    ASSERT_LT(point.maxCoeff(), 1.0);
    mean += point / 5000.0;
  }
  EXPECT_LT((mean.array() - 0.5).abs().maxCoeff(), 0.15);
}

}  // namespace
}  // namespace handway::sampling
