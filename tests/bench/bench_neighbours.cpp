/// Measures the cost of the nearest of many nodes: a query and the insertion of a node, by their
/// number, with trees and by a linear search; `ratio` is the latter by the former, query and
/// insertion together. Nodes lie anywhere in the space of an arm of 6 joints, of an arm with a hand
/// of 13 more, and around the arm's straight motion with the hand in a subspace of 5 dimensions.
/// Times are medians.
#include "roadmap/neighbours.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

constexpr int kArmJoints = 6;
constexpr int kHandJoints = 13;
constexpr int kJoints = kArmJoints + kHandJoints;

/// Distribution of the nodes.
enum class Cloud { kArm, kCorridor, kHandArm };

Eigen::VectorXd uniform(std::mt19937& random, Eigen::Index size) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Eigen::VectorXd point(size);
  for (double& coordinate : point) {
    coordinate = share(random);
  }
  return point;
}

Eigen::VectorXd in_corridor(std::mt19937& random) {
  static const Eigen::MatrixXd kAxes = [] {
    std::mt19937 axes(1);
    Eigen::MatrixXd result(kHandJoints, 5);
    for (auto axis : result.colwise()) {
      axis = uniform(axes, kHandJoints) / 5.0;
    }
    return result;
  }();
  Eigen::VectorXd point(kJoints);
  point.head(kArmJoints) = 0.1 * uniform(random, kArmJoints).array() + uniform(random, 1)[0];
  point.tail(kHandJoints) = kAxes * uniform(random, 5);
  return point;
}

Eigen::VectorXd draw(Cloud cloud, std::mt19937& random) {
  return cloud == Cloud::kCorridor ? in_corridor(random)
                                   : uniform(random, cloud == Cloud::kArm ? kArmJoints : kJoints);
}

using Clock = std::chrono::steady_clock;

double microseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void bm_neighbours(benchmark::State& state, Cloud cloud, int k) {
  std::mt19937 random(7);
  const auto count = static_cast<int>(state.range(0));
  Neighbours trees;
  Neighbours linear(std::numeric_limits<int>::max());
  double insertion = 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::VectorXd point = draw(cloud, random);
    linear.add(i, point);
    const Clock::time_point begin = Clock::now();
    trees.add(i, point);
    insertion += microseconds_since(begin) / count;
  }
  std::vector<double> by_trees;
  std::vector<double> by_looking_at_all;
  for (auto _ : state) {
    const Eigen::VectorXd query = draw(cloud, random);
    const auto ask = [&](const Neighbours& neighbours, std::vector<double>& times) {
      const Clock::time_point begin = Clock::now();
      benchmark::DoNotOptimize(neighbours.nearest(query, k));
      times.push_back(microseconds_since(begin));
    };
    if (by_trees.size() % 2 == 0) {  // by turns: the second has the query in the cache
      ask(trees, by_trees);
      ask(linear, by_looking_at_all);
    } else {
      ask(linear, by_looking_at_all);
      ask(trees, by_trees);
    }
  }
  state.counters["insertion_us"] = insertion;
  state.counters["trees_us"] = median(by_trees);
  state.counters["linear_us"] = median(by_looking_at_all);
  state.counters["ratio"] = median(by_looking_at_all) / (median(by_trees) + insertion);
}

}  // namespace
}  // namespace handway::planning

int main(int argc, char** argv) {
  using handway::planning::Cloud;
  benchmark::Initialize(&argc, argv);
  for (const auto& [name, cloud] :
       {std::pair("arm", Cloud::kArm), std::pair("corridor", Cloud::kCorridor),
        std::pair("hand_arm", Cloud::kHandArm)}) {
    for (const int k : {1, 10}) {
      benchmark::RegisterBenchmark((std::string(name) + "/k:" + std::to_string(k)).c_str(),
                                   [cloud = cloud, k](benchmark::State& state) {
                                     handway::planning::bm_neighbours(state, cloud, k);
                                   })
          ->RangeMultiplier(10)
          ->Range(100, 100000)
          ->Iterations(256)
          ->Unit(benchmark::kMicrosecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
