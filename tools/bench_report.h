#pragma once

#include "collision_bench.h"
#include "plan_bench.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::tools {

/// Settings of a benchmark.
struct BenchSettings {
  int seeds = 10;
  int threads = 1;
  double time_limit_s = 30.0;
  std::vector<std::string> checkers = {"fast"};  ///< Keys of checker_kinds(), for plans.
  bool check_paths = false;                      ///< Every path found is checked.
};

/// Settings of making and running variants, beside BenchSettings.
struct VariantSettings {
  int count = 0;                     ///< Number per problem; 0: the problems themselves are run.
  std::uint64_t seed = 1;            ///< Seed of the variants.
  bool only_missed = false;          ///< Other planners run if the default found no path.
  double others_time_limit_s = 0.0;  ///< Limit of other planners; 0: BenchSettings::time_limit_s.
};

/// Measurements on one scene.
struct SceneBench {
  std::filesystem::path file;
  double load_s = 0.0;     ///< Time from the files to a ready problem.
  std::size_t memory = 0;  ///< Peak while loading, bytes.
  CollisionBench collision;
  /// The scene's own planner with the first checker first; empty: not requested.
  std::vector<PlanBench> plans;

  [[nodiscard]] std::string name() const { return file.stem().string(); }
};

/// Ratio of the median time of planning and smoothing of plans[i] to that of the scene's own
/// planner; NaN if either has none.
[[nodiscard]] double time_ratio(const SceneBench& scene, std::size_t i);

/// One row per scene and planner, keys as in docs/command-line.md; a number that does not exist is
/// an empty cell.
[[nodiscard]] std::string bench_csv(const BenchSettings& settings,
                                    const std::vector<SceneBench>& scenes);

/// Everything, each run included; a number that does not exist is null.
[[nodiscard]] std::string bench_json(const BenchSettings& settings,
                                     const std::vector<SceneBench>& scenes);

/// The variants of each problem, with all runs and the planners that missed a path.
[[nodiscard]] std::string variants_json(const BenchSettings& settings,
                                        const VariantSettings& variants,
                                        const std::vector<VariantBench>& benches);

}  // namespace handway::tools
