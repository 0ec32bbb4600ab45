#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace handway::sampling {
namespace {

// Pearson's statistic of `counts` against equal shares.
double chi_squared(const std::vector<int>& counts) {
  double total = 0.0;
  for (const int count : counts) {
    total += count;
  }
  const double expected = total / static_cast<double>(counts.size());
  double sum = 0.0;
  for (const int count : counts) {
    sum += (count - expected) * (count - expected) / expected;
  }
  return sum;
}

TEST(RandomStream, GivesThePublishedValuesOfXoshiro256PlusPlus) {
  RandomStream stream(0);
  EXPECT_EQ(stream.bits(), 5987356902031041503u);
  EXPECT_EQ(stream.bits(), 7051070477665621255u);
  EXPECT_EQ(stream.bits(), 6633766593972829180u);
  EXPECT_EQ(stream.bits(), 211316841551650330u);
}

TEST(RandomStream, RepeatsForTheSameSeed) {
  RandomStream one(42);
  RandomStream two(42);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(one.bits(), two.bits());
  }
}

TEST(RandomStream, IsUniformInTheUnitInterval) {
  RandomStream stream(1);
  std::vector<int> counts(100, 0);
  double sum = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++counts[static_cast<std::size_t>(u * 100.0)];
    sum += u;
  }
  EXPECT_NEAR(sum / 100000.0, 0.5, 0.004);
  EXPECT_LT(chi_squared(counts), 149.4);  // 99 degrees of freedom, 0.1 % level
}

TEST(RandomStream, IsUniformInPairsOfSuccessiveValues) {
  RandomStream stream(2);
  std::vector<int> counts(100, 0);
  for (int i = 0; i < 100000; ++i) {
    const Eigen::VectorXd u = stream.uniform(2);
    ++counts[static_cast<std::size_t>(u[0] * 10.0) * 10 + static_cast<std::size_t>(u[1] * 10.0)];
  }
  EXPECT_LT(chi_squared(counts), 149.4);
}

TEST(RandomStream, DrawsVectorsAsItDrawsNumbers) {
  RandomStream one(7);
  RandomStream two(7);
  const Eigen::VectorXd values = one.uniform(5);
  ASSERT_EQ(values.size(), 5);
  for (const double value : values) {
    EXPECT_EQ(value, two.uniform());
  }
  EXPECT_EQ(one.uniform(0).size(), 0);
}

TEST(RandomStream, ForksByIndexWhateverWasDrawnBefore) {
  RandomStream stream(5);
  RandomStream before = stream.fork(3);
  stream.uniform(100);
  RandomStream after = stream.fork(3);
  EXPECT_EQ(before.bits(), after.bits());
}

TEST(RandomStream, ForksIntoDifferentStreams) {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const RandomStream stream(seed);
    firsts.insert(RandomStream(stream).bits());
    for (std::uint64_t i = 0; i < 100; ++i) {
      const RandomStream child = stream.fork(i);
      firsts.insert(RandomStream(child).bits());
      firsts.insert(child.fork(i + 1).bits());
    }
  }
  EXPECT_EQ(firsts.size(), 10u * 201u);
}

TEST(RandomStream, HasUncorrelatedForks) {
  constexpr int kCount = 20000;
  const RandomStream parent(11);
  for (std::uint64_t i = 0; i < 5; ++i) {
    RandomStream one = parent.fork(i);
    RandomStream two = parent.fork(i + 1);
    double covariance = 0.0;
    for (int k = 0; k < kCount; ++k) {
      covariance += (one.uniform() - 0.5) * (two.uniform() - 0.5) / kCount;
    }
    EXPECT_LT(std::abs(12.0 * covariance), 4.0 / std::sqrt(kCount));
  }
}

TEST(RandomStream, IsUniformOverFirstValuesOfForks) {
  const RandomStream parent(1);
  std::vector<int> counts(100, 0);
  for (std::uint64_t i = 0; i < 100000; ++i) {
    ++counts[static_cast<std::size_t>(parent.fork(i).uniform() * 100.0)];
  }
  EXPECT_LT(chi_squared(counts), 149.4);
}

TEST(RandomStream, DrawsEveryNumberBelowEquallyOften) {
  RandomStream stream(3);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 70000; ++i) {
    ++counts[stream.below(7)];
  }
  EXPECT_LT(chi_squared(counts), 22.5);  // 6 degrees of freedom, 0.1 % level
  EXPECT_EQ(stream.below(1), 0u);
  EXPECT_THROW(stream.below(0), std::invalid_argument);
}

TEST(RandomStream, DrawsNormalNumbers) {
  RandomStream stream(4);
  constexpr int kCount = 100000;
  std::array<double, 4> moments{};
  int within_one_sigma = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = stream.normal();
    double power = 1.0;
    for (double& moment : moments) {
      power *= x;
      moment += power / kCount;
    }
    within_one_sigma += std::abs(x) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(moments[0], 0.0, 0.015);
  EXPECT_NEAR(moments[1], 1.0, 0.02);
  EXPECT_NEAR(moments[2], 0.0, 0.05);
  EXPECT_NEAR(moments[3], 3.0, 0.15);
  EXPECT_NEAR(within_one_sigma / double{kCount}, 0.682689, 0.006);
}

}  // namespace
}  // namespace handway::sampling
