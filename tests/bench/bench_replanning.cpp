/// An object dragged in steps of a centimetre: planning again with a dynamic roadmap, which
/// keeps what it knows, and planning anew.
#include "handway/planning/planners/planner.h"
#include "handway/planning/replanning/dynamic_roadmap.h"
#include "handway_test/known_problems.h"
#include "handway_test/roadmap_scenes.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

/// Moves away from its place and back, so that a drag can go on for ever.
struct Drag {
  std::string scene;
  std::string object;
  Eigen::Vector3d direction;  ///< In the world, unit length.
  int steps;                  ///< Number of steps of 1 cm, one way.
};

constexpr double kStep = 0.01;  // m

PlanningProblem problem_of(const std::string& scene) {
  const std::vector<test::KnownProblem> all = test::known_problems();
  const auto found = std::ranges::find(all, scene, &test::KnownProblem::name);
  const SceneState loaded = test::load(*found);
  return make_problem(loaded.scene, loaded.basis);
}

geometric::Pose place_of(const geometric::Pose& X_WO, const Drag& drag, int step) {
  const int phase = step % (2 * drag.steps);
  const int along = std::min(phase, 2 * drag.steps - phase);
  geometric::Pose X_WMoved = X_WO;
  X_WMoved.translation() += kStep * along * drag.direction;
  return X_WMoved;
}

/// Sum over the queries of a benchmark.
struct Sum {
  double checks = 0.0;
  double slowest_s = 0.0;
  int solved = 0;

  void add(const PlanResult& result, double time_s) {
    checks += static_cast<double>(result.statistics.checks());
    slowest_s = std::max(slowest_s, time_s);
    solved += result.solved() ? 1 : 0;
  }

  void report(benchmark::State& state) const {
    const auto queries = static_cast<double>(state.iterations());
    state.counters["checks"] = checks / queries;
    state.counters["solved"] = solved / queries;
    state.counters["slowest_ms"] = 1e3 * slowest_s;
  }
};

// Time of planning and smoothing, without the checker of the changed scene and the certificate,
// which both ways have in common.
double search_time(const PlanResult& result) { return result.time_s + result.smoothing_s; }

void bm_dynamic_roadmap(benchmark::State& state, const Drag& drag) {
  DynamicRoadmap roadmap(problem_of(drag.scene));
  const geometric::Pose X_WO = geometric::find_object(*roadmap.problem().scene, drag.object)->X_PO;
  (void)roadmap.plan({});
  Sum sum;
  int kept = 0;
  int anew = 0;
  int step = 0;
  for (auto _ : state) {
    test::move_object(roadmap, drag.object, place_of(X_WO, drag, ++step));
    const PlanResult result = roadmap.plan({});
    state.SetIterationTime(search_time(result));
    sum.add(result, search_time(result));
    kept += roadmap.source() == ReplanSource::kLastPath ? 1 : 0;
    anew += roadmap.source() == ReplanSource::kPlanner ? 1 : 0;
  }
  sum.report(state);
  state.counters["kept"] = static_cast<double>(kept) / static_cast<double>(state.iterations());
  state.counters["anew"] = static_cast<double>(anew) / static_cast<double>(state.iterations());
}

void bm_anew(benchmark::State& state, const Drag& drag) {
  DynamicRoadmap moved(problem_of(drag.scene));  // for its problem alone
  const geometric::Pose X_WO = geometric::find_object(*moved.problem().scene, drag.object)->X_PO;
  const auto planner = PlannerRegistry().create("auto");
  Sum sum;
  int step = 0;
  for (auto _ : state) {
    test::move_object(moved, drag.object, place_of(X_WO, drag, ++step));
    const PlanResult result = planner->plan(moved.problem(), {});
    state.SetIterationTime(search_time(result));
    sum.add(result, search_time(result));
  }
  sum.report(state);
}

}  // namespace
}  // namespace handway::planning

int main(int argc, char** argv) {
  using handway::planning::Drag;
  // The drags are short enough that the goal stays free.
  const std::vector<Drag> drags{
      {"can_on_table", "can", {-1.0, 0.0, 0.0}, 1},
      {"cans_in_shelf", "can_right", {0.0, 1.0, 0.0}, 6},
  };
  for (const Drag& drag : drags) {
    const std::string name = drag.scene + "/" + drag.object;
    benchmark::RegisterBenchmark(("dynamic/" + name).c_str(), handway::planning::bm_dynamic_roadmap,
                                 drag)
        ->UseManualTime()
        ->Iterations(drag.steps * 12)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("anew/" + name).c_str(), handway::planning::bm_anew, drag)
        ->UseManualTime()
        ->Iterations(drag.steps * 12)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
