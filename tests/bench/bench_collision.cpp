/// One configuration near a query segment, every pair, with FclChecker and with
/// BoundedChecker; and one edge of the length that planners connect. On the
/// published problems where they are, else on simple shapes.
#include "handway/geometric/collision/bounded_checker.h"
#include "handway/geometric/collision/edge_checker.h"
#include "handway/geometric/collision/fcl_checker.h"
#include "handway_test/paths.h"
#include "handway_test/robots.h"
#include "handway_test/solid_robots.h"
#include "kautham_importer.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kResolution = 5e-5;  // m
constexpr double kEdge = 0.1;         // of the segment

/// A scene with a segment to draw configurations around.
struct Problem {
  std::shared_ptr<const CollisionWorld> world;
  Configuration start;
  Configuration goal;
};

Problem simple_problem() {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  test::add_object(scene, "table", Box{{1, 1, 0.05}}, Eigen::Vector3d(0.9, 0, 0.9));
  test::add_object(scene, "can", Cylinder{0.03, 0.12}, Eigen::Vector3d(0.6, 0, 0.99));
  auto world = std::make_shared<const CollisionWorld>(scene);
  const Configuration start = world->model().neutral();
  return {world, start, start + 0.3 * (world->model().upper() - start)};
}

const Problem& problem(int number) {
  static const std::vector<Problem> kProblems = [] {
    std::vector<Problem> made{simple_problem()};
    if (const auto reference = test::reference_dir()) {
      for (const std::string name : {"TwoCanb_new", "CanBox_new", "ShelfCan2_new"}) {
        const auto loaded = import_kautham::KauthamImporter().read(
            *reference / "auro" / ("TX90_RHand_ICRA10_5PMD_" + name + ".xml"));
        made.push_back({std::make_shared<const CollisionWorld>(*loaded.scene), *loaded.scene->start,
                        *loaded.scene->goal});
      }
    }
    return made;
  }();
  return number < static_cast<int>(kProblems.size()) ? kProblems[static_cast<std::size_t>(number)]
                                                     : kProblems.front();
}

// Around the segment, as far as the planners' corridors reach.
std::vector<Configuration> near_segment(const Problem& problem, int count) {
  constexpr double kSpread = 0.05;
  const RobotModel& model = problem.world->model();
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Configuration> configurations;
  for (int k = 0; k < count; ++k) {
    Configuration q = problem.start + uniform(engine) * (problem.goal - problem.start);
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] += kSpread * (2.0 * uniform(engine) - 1.0) * (model.upper()[v] - model.lower()[v]);
    }
    configurations.push_back(q);
  }
  return configurations;
}

template <typename Checker>
void bm_configuration(benchmark::State& state) {
  const Problem& chosen = problem(static_cast<int>(state.range(0)));
  Checker checker(chosen.world);
  const std::vector<Configuration> configurations = near_segment(chosen, 256);
  int in_collision = 0;
  for (const Configuration& q : configurations) {  // fills what is remembered
    in_collision += checker.first_collision(q) ? 1 : 0;
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.first_collision(configurations[k++ % configurations.size()]));
  }
  state.counters["in_collision"] = in_collision / static_cast<double>(configurations.size());
}
BENCHMARK(bm_configuration<FclChecker>)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_configuration<BoundedChecker>)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

template <typename Checker>
void bm_edge(benchmark::State& state) {
  const Problem& chosen = problem(static_cast<int>(state.range(0)));
  Checker checker(chosen.world);
  const auto motion = std::make_shared<const MotionBound>(*chosen.world);
  EdgeChecker edges(checker, motion, kResolution);
  const Configuration way = kEdge * (chosen.goal - chosen.start);
  std::vector<Configuration> starts;
  for (const Configuration& q : near_segment(chosen, 64)) {
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
BENCHMARK(bm_edge<FclChecker>)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_edge<BoundedChecker>)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace handway::geometric
