#include "handway/sampling/sequences/low_discrepancy.h"

#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace handway::sampling {
namespace {

TEST(SweepPosition, FollowsThePaperOrder) {
  const std::vector<double> positions = {0, 1, 0.5, 0.25, 0.75, 0.125, 0.625};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_EQ(sweep_position(i), positions[i]);
  }
}

TEST(SweepPosition, VisitsEvenlySpacedPointsOnce) {
  for (const std::uint64_t steps : {1u, 2u, 16u, 1024u}) {
    std::set<double> visited;
    for (std::uint64_t i = 0; i <= steps; ++i) {
      visited.insert(sweep_position(i));
    }
    std::set<double> expected;
    for (std::uint64_t i = 0; i <= steps; ++i) {
      expected.insert(static_cast<double>(i) / static_cast<double>(steps));
    }
    EXPECT_EQ(visited, expected);
  }
}

TEST(SweepPosition, StaysBelowOne) {
  EXPECT_LT(sweep_position(std::numeric_limits<std::uint64_t>::max()), 1.0);
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
    EXPECT_EQ(boxes_hit(HaltonSequence(2, 99), first), 72);
  }
}

TEST(HaltonSequence, RefusesNoDimensions) {
  EXPECT_THROW(HaltonSequence(0, 1), std::invalid_argument);
}

TEST(HaltonSequence, BreaksTheLinesOfManyDimensionsByPermutations) {
  constexpr int kPoints = 60;  // below the bases 71 and 73 of the last two axes
  const auto correlation = [&](const HaltonSequence& sequence) {
    Eigen::MatrixXd points(kPoints, 2);
    for (int i = 0; i < kPoints; ++i) {
      points.row(i) = sequence.point(static_cast<std::uint64_t>(i)).tail(2);
    }
    const Eigen::MatrixXd centred = points.rowwise() - points.colwise().mean();
    return centred.col(0).dot(centred.col(1)) / (centred.col(0).norm() * centred.col(1).norm());
  };
  EXPECT_LT(std::abs(correlation(HaltonSequence(21, 5))), 0.4);  // 0.99 without permutations
}

TEST(HaltonSequence, WorksInManyDimensions) {
  const HaltonSequence sequence(200, 3);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(200);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Eigen::VectorXd point = sequence.point(i);
    ASSERT_GE(point.minCoeff(), 0.0);
    ASSERT_LT(point.maxCoeff(), 1.0);
    mean += point / 5000.0;
  }
  EXPECT_LT((mean.array() - 0.5).abs().maxCoeff(), 0.15);
}

std::vector<int> cell_of(const Eigen::VectorXd& point, int level) {
  std::vector<int> cell;
  for (const double x : point) {
    cell.push_back(static_cast<int>(std::ldexp(x, level)));
  }
  return cell;
}

TEST(SdkSequence, HasThePublishedMatrices) {
  EXPECT_EQ(sdk_matrix(1), Eigen::MatrixXi::Ones(1, 1));
  EXPECT_EQ(sdk_matrix(2), (Eigen::Matrix2i() << 1, 0, 1, 1).finished());
  EXPECT_EQ(sdk_matrix(4),
            (Eigen::Matrix4i() << 1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1).finished());
  EXPECT_EQ(sdk_matrix(5), sdk_matrix(6).topLeftCorner(5, 5));
  EXPECT_THROW(static_cast<void>(sdk_matrix(0)), std::invalid_argument);
}

TEST(SdkSequence, HasInvertibleMatrices) {
  for (int d = 1; d <= 40; ++d) {
    const Eigen::MatrixXi T = sdk_matrix(d);
    ASSERT_EQ(T.rows(), d);
    EXPECT_TRUE((T.diagonal().array() == 1).all()) << d;
    EXPECT_TRUE(T.isLowerTriangular()) << d;
  }
}

TEST(SdkSequence, OrdersTheQuadrantsByMutualDistance) {
  const SdkSequence sequence(2, 1);
  EXPECT_EQ(sequence.corner(0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(sequence.corner(1), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(sequence.corner(2), Eigen::Vector2d(0.0, 0.5));
  EXPECT_EQ(sequence.corner(3), Eigen::Vector2d(0.5, 0.0));
  EXPECT_EQ(sequence.corner(4), sequence.corner(0));
}

TEST(SdkSequence, RefinesTheGridLevelByLevel) {
  const SdkSequence sequence(2, 2);
  EXPECT_EQ(sequence.side(), 0.25);
  EXPECT_EQ(sequence.corner(1), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(sequence.corner(4), Eigen::Vector2d(0.25, 0.25));
  EXPECT_EQ(sequence.corner(5), Eigen::Vector2d(0.75, 0.75));
}

TEST(SdkSequence, VisitsEveryCellOfEveryLevelOnce) {
  for (const auto& [d, levels] : {std::pair{1, 10}, {2, 6}, {3, 4}, {5, 2}, {6, 2}, {11, 1}}) {
    const SdkSequence sequence(d, levels);
    for (int level = 1; level <= levels; ++level) {
      const std::uint64_t count = std::uint64_t{1} << (d * level);
      std::set<std::vector<int>> cells;
      for (std::uint64_t k = 0; k < count; ++k) {
        cells.insert(cell_of(sequence.corner(k), level));
      }
      EXPECT_EQ(cells.size(), count) << d << " dimensions, level " << level;
    }
  }
}

// Returns in how many axes two of the first `count` cells of level 1 differ at least.
double mutual_distance(const SdkSequence& sequence, std::uint64_t count) {
  double smallest = sequence.dimension();
  for (std::uint64_t i = 0; i < count; ++i) {
    for (std::uint64_t j = 0; j < i; ++j) {
      smallest = std::min(smallest, 2.0 * (sequence.corner(i) - sequence.corner(j)).lpNorm<1>());
    }
  }
  return smallest;
}

TEST(SdkSequence, MeetsNoNeighboursInTheFirstHalfOfTheCells) {
  for (const int d : {2, 3, 4, 6, 8, 9}) {
    EXPECT_GE(mutual_distance(SdkSequence(d, 1), std::uint64_t{1} << (d - 1)), 2.0) << d;
  }
}

TEST(SdkSequence, StartsWithOppositeCornersWhereTheDimensionIsAPowerOfTwo) {
  for (const int d : {2, 4, 8, 16}) {
    EXPECT_EQ(mutual_distance(SdkSequence(d, 1), 2), d);
  }
}

// Radius of the largest ball (maximum norm) without a sample, estimated at probes.
double dispersion(const std::vector<Eigen::VectorXd>& samples, int d) {
  RandomStream stream(7);
  double largest = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const Eigen::VectorXd probe = stream.uniform(d);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::VectorXd& sample : samples) {
      nearest = std::min(nearest, (probe - sample).lpNorm<Eigen::Infinity>());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(SdkSequence, HasLowerDispersionThanRandomPoints) {
  for (const auto& [d, levels, count] : {std::tuple{2, 5, 1024}, {2, 5, 600}, {3, 3, 512}}) {
    const SdkSequence sequence(d, levels);
    RandomStream stream(3);
    std::vector<Eigen::VectorXd> sdk;
    std::vector<Eigen::VectorXd> random;
    for (int k = 0; k < count; ++k) {
      sdk.emplace_back(sequence.corner(static_cast<std::uint64_t>(k)).array() +
                       0.5 * sequence.side());
      random.push_back(stream.uniform(d));
    }
    EXPECT_LT(dispersion(sdk, d), 0.7 * dispersion(random, d)) << d << ' ' << count;
    if (count == 1 << (d * levels)) {
      EXPECT_LE(dispersion(sdk, d), sequence.side() / 2.0);  // a Sukharev grid: the least possible
    }
  }
}

TEST(SdkSequence, WorksInManyDimensions) {
  const SdkSequence sequence(22, 10);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Eigen::VectorXd point = sequence.corner(k * 0x123456789abcdefu);
    ASSERT_GE(point.minCoeff(), 0.0);
    ASSERT_LE(point.maxCoeff(), 1.0);
  }
  EXPECT_NO_THROW(static_cast<void>(SdkSequence(100, 2).corner(~std::uint64_t{0})));
}

TEST(SdkSequence, RefusesLevelsBeyondADoublesPrecision) {
  EXPECT_THROW(SdkSequence(2, 0), std::invalid_argument);
  EXPECT_THROW(SdkSequence(2, 53), std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
