/// Measures how the time of a configuration grows with the number of obstacles, with the
/// triangles of one, and with threads; and the cost of building a checker, in time and
/// memory.
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/resource_use.h"
#include "handway_test/robots.h"
#include "handway_test/solid_robots.h"
#include "random_configurations.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using WorldPtr = std::shared_ptr<const CollisionWorld>;

constexpr int kConfigurations = 256;

// Small boxes where the arm can reach, none at its base.
WorldPtr scattered_boxes(int count) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p_WO;
    do {
      p_WO = Eigen::Vector3d(1.2 * uniform(engine), 1.2 * uniform(engine),
                             0.75 + 0.75 * uniform(engine));
    } while (p_WO.head<2>().norm() < 0.35);
    test::add_object(scene, "box " + std::to_string(i), Box{{0.02, 0.02, 0.02}}, p_WO);
  }
  return std::make_shared<const CollisionWorld>(scene);
}

// A rough ball of about `count` triangles: it bulges by 5 % of its radius.
Mesh rough_ball(int count) {
  const int rings = std::max(3, static_cast<int>(std::sqrt(count / 4.0)));
  const int sectors = 2 * rings;
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const double polar = std::numbers::pi * i / rings;
      const double azimuth = 2.0 * std::numbers::pi * j / sectors;
      const double radius = 0.25 * (1.0 + 0.05 * std::sin(9.0 * polar) * std::cos(7.0 * azimuth));
      mesh.vertices.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                                       std::sin(polar) * std::sin(azimuth),
                                                       std::cos(polar)));
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * sectors + j % sectors);
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) {
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      }
      if (i + 1 < rings) {
        mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
      }
    }
  }
  return {{}, Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

WorldPtr one_ball(int triangles) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  test::add_object(scene, "ball", rough_ball(triangles), Eigen::Vector3d(0.7, 0, 0.8));
  return std::make_shared<const CollisionWorld>(scene);
}

void ask(benchmark::State& state, CollisionChecker& checker) {
  const std::vector<Configuration> configurations =
      test::random_configurations(checker.world().model(), kConfigurations);
  int in_collision = 0;
  for (const Configuration& q : configurations) {  // fills what is remembered
    in_collision += checker.first_collision(q) ? 1 : 0;
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.first_collision(configurations[k++ % configurations.size()]));
  }
  state.counters["in_collision"] = benchmark::Counter(
      in_collision / static_cast<double>(kConfigurations), benchmark::Counter::kAvgThreads);
}

template <typename Checker>
void bm_obstacles(benchmark::State& state) {
  Checker checker(scattered_boxes(static_cast<int>(state.range(0))));
  ask(state, checker);
}

template <typename Checker>
void bm_triangles(benchmark::State& state) {
  Checker checker(one_ball(static_cast<int>(state.range(0))));
  ask(state, checker);
}

// Every thread queries its own clone; times are real time per query, all threads together.
template <typename Checker>
void bm_threads(benchmark::State& state) {
  static const Checker kChecker(scattered_boxes(100));
  const std::unique_ptr<CollisionChecker> clone = kChecker.clone();
  ask(state, *clone);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}

// Measures the time from a scene in memory to the first answer. peak_MB is the peak memory of the
// process so far: run one case alone (--benchmark_filter) to see its own.
template <typename Checker>
void bm_load(benchmark::State& state) {
  const WorldPtr world = one_ball(static_cast<int>(state.range(0)));
  const Configuration neutral = world->model().neutral();
  for (auto _ : state) {
    Checker checker(world);
    benchmark::DoNotOptimize(checker.first_collision(neutral));
  }
  state.counters["peak_MB"] = static_cast<double>(test::peak_memory()) / 1e6;
}

// Boxes of a size of their own each, all around.
Scene boxes_of_all_sizes(int count) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size(uniform(engine), uniform(engine), uniform(engine));
    const Eigen::Vector3d place(uniform(engine), uniform(engine), uniform(engine));
    test::add_object(scene, "box " + std::to_string(i),
                     Box{0.02 * Eigen::Vector3d::Ones() + 0.3 * size},
                     Eigen::Vector3d(2.0, 2.0, 0.0) + 4.0 * place);
  }
  return scene;
}

// Measures a scene of boxes including its world. The baseline is FclChecker in the same run.
template <typename Checker>
void bm_load_boxes(benchmark::State& state) {
  const Scene scene = boxes_of_all_sizes(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const auto world = std::make_shared<const CollisionWorld>(scene);
    Checker checker(world);
    benchmark::DoNotOptimize(checker.first_collision(world->model().neutral()));
  }
  state.counters["peak_MB"] = static_cast<double>(test::peak_memory()) / 1e6;
}

#define HANDWAY_GROWTH(Checker)                                                                    \
  BENCHMARK(bm_obstacles<Checker>)                                                                 \
      ->RangeMultiplier(10)                                                                        \
      ->Range(1, 1000)                                                                             \
      ->Unit(benchmark::kMicrosecond);                                                             \
  BENCHMARK(bm_triangles<Checker>)                                                                 \
      ->RangeMultiplier(10)                                                                        \
      ->Range(1000, 1000000)                                                                       \
      ->Unit(benchmark::kMicrosecond);                                                             \
  BENCHMARK(bm_threads<Checker>)->ThreadRange(1, 4)->UseRealTime()->Unit(benchmark::kMicrosecond); \
  BENCHMARK(bm_load<Checker>)                                                                      \
      ->RangeMultiplier(10)                                                                        \
      ->Range(1000, 1000000)                                                                       \
      ->Unit(benchmark::kMillisecond);                                                             \
  BENCHMARK(bm_load_boxes<Checker>)                                                                \
      ->RangeMultiplier(10)                                                                        \
      ->Range(10, 10000)                                                                           \
      ->Unit(benchmark::kMillisecond)

HANDWAY_GROWTH(FclChecker);
HANDWAY_GROWTH(FclBroadphaseChecker);
HANDWAY_GROWTH(ExactCollisionChecker);

}  // namespace
}  // namespace handway::geometric
