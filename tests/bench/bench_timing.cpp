/// Timing the paths of the scenes that ship: how long it takes, and the duration of the motion
/// by the lower bound that no motion through the same waypoints stays below (`ratio`).
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/known_problems.h"

#include <benchmark/benchmark.h>

#include <stdexcept>
#include <string>

namespace handway::planning {
namespace {

void bm_time_path(benchmark::State& state, const test::KnownProblem& known, double deviation) {
  const SceneState loaded = test::load(known);
  const PlanningProblem problem = make_problem(loaded.scene, loaded.basis);
  const PlannerRegistry registry;
  const PlanResult plan = registry.create(registry.names().front())->plan(problem, {});
  if (!plan.solved()) {
    throw std::runtime_error(known.name + ": " + plan.reason);
  }
  TimingOptions options;
  options.blends.deviation = deviation;
  TimedPath timed;
  for (auto _ : state) {
    timed = time_path(problem, plan.path, known.name, options);
  }
  state.counters["cleared"] = timed.cleared() ? 1.0 : 0.0;
  state.counters["duration_s"] = timed.preflight.duration;
  state.counters["ratio"] = timed.preflight.duration / timed.least_duration;
}

}  // namespace
}  // namespace handway::planning

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const handway::test::KnownProblem& problem : handway::test::known_problems()) {
    for (const double deviation : {0.05, 0.0}) {
      benchmark::RegisterBenchmark((problem.name + (deviation > 0.0 ? "/arcs" : "/stops")).c_str(),
                                   [problem, deviation](benchmark::State& state) {
                                     handway::planning::bm_time_path(state, problem, deviation);
                                   })
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
