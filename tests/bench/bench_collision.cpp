/// One configuration near a query's segment, and one edge of the length that planners
/// connect, with FCL pair by pair, FCL with its broad phase and the everyday checker,
/// on every known problem.
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway_test/known_problems.h"

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::CollisionProblem;
using test::KnownProblem;

constexpr double kResolution = 5e-5;  // m
constexpr double kEdge = 0.1;         // of the segment
constexpr int kConfigurations = 256;
constexpr int kEdges = 64;

const CollisionProblem& loaded(const KnownProblem& problem) {
  static std::map<std::string, CollisionProblem> problems;
  const auto found = problems.find(problem.name);
  return found != problems.end()
             ? found->second
             : problems.emplace(problem.name, *test::load(problem).scene).first->second;
}

template <typename Checker>
void bm_configuration(benchmark::State& state, const KnownProblem& problem) {
  const CollisionProblem& chosen = loaded(problem);
  Checker checker(chosen.world);
  const std::vector<Configuration> configurations = near_segment(chosen, kConfigurations);
  int in_collision = 0;
  for (const Configuration& q : configurations) {  // fills what is remembered
    in_collision += checker.first_collision(q) ? 1 : 0;
  }
  checker.reset_counts();
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.first_collision(configurations[k++ % configurations.size()]));
  }
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  state.counters["in_collision"] = share(in_collision, kConfigurations);
  state.counters["exact_tests"] = share(static_cast<double>(checker.counts().exact_tests),
                                        static_cast<double>(checker.counts().configurations));
}

template <typename Checker>
void bm_edge(benchmark::State& state, const KnownProblem& problem) {
  const CollisionProblem& chosen = loaded(problem);
  Checker checker(chosen.world);
  const auto motion = std::make_shared<const MotionBound>(*chosen.world);
  ContinuousCollisionChecker edges(checker, motion, kResolution);
  const Configuration way = kEdge * (chosen.goal - chosen.start);
  std::vector<Configuration> starts;
  for (const Configuration& q : near_segment(chosen, kEdges)) {
    if (!checker.first_collision(q) && !checker.first_collision(q + way)) {
      starts.push_back(q);
    }
  }
  if (starts.empty()) {
    state.SkipWithError("no edge has free ends");
    return;
  }
  std::size_t k = 0;
  std::size_t checks = 0;
  std::size_t free = 0;
  for (auto _ : state) {
    const Configuration& q = starts[k++ % starts.size()];
    const EdgeResult result = edges.check(q, q + way);
    checks += result.checks;
    free += result.free ? 1 : 0;
  }
  state.counters["checks"] = static_cast<double>(checks) / static_cast<double>(k);
  state.counters["free"] = static_cast<double>(free) / static_cast<double>(k);
}

template <typename Checker>
void add_benchmarks(const std::string& checker) {
  for (const KnownProblem& problem : test::known_problems()) {
    benchmark::RegisterBenchmark(("configuration/" + checker + "/" + problem.name).c_str(),
                                 bm_configuration<Checker>, problem)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("edge/" + checker + "/" + problem.name).c_str(), bm_edge<Checker>,
                                 problem)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace
}  // namespace handway::geometric

int main(int argc, char** argv) {
  handway::geometric::add_benchmarks<handway::geometric::FclChecker>("fcl");
  handway::geometric::add_benchmarks<handway::geometric::FclBroadphaseChecker>("fcl_broadphase");
  handway::geometric::add_benchmarks<handway::geometric::ExactCollisionChecker>("bounded");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
