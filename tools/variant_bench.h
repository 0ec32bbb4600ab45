#pragma once

#include "plan_bench.h"
#include "scene_variants.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {

/// A variant and the runs on it.
struct VariantRuns {
  SceneVariant variant;
  std::vector<PlanBench> plans;  ///< One a planner, the default first; empty without a scene.
};

/// What planners did on the variants of one problem.
struct VariantBench {
  std::filesystem::path file;
  std::string target;  ///< Objects that the goal is kept relative to; may be empty.
  std::vector<VariantRuns> variants;

  [[nodiscard]] std::string name() const { return file.stem().string(); }
};

/// A variant and a seed that the default planner missed, and who solved it.
struct MissedPair {
  std::string file;  ///< Of the problem.
  int variant = 0;
  std::uint64_t seed = 0;
  std::string reason;                                     ///< The default's.
  std::vector<std::pair<std::string, double>> solved_by;  ///< Other planners with their time, s.
};

/// (Variant, seed) pairs, counted.
struct VariantSummary {
  std::size_t pairs = 0;
  std::size_t solved_by_any = 0;
  std::size_t solved_by_default = 0;
  std::vector<MissedPair> missed;  ///< By the default, solved by another one or not.

  VariantSummary& operator+=(const VariantSummary& other);
  /// Of the pairs that any planner solved, the share that the default did; NaN if there is none.
  [[nodiscard]] double default_share() const;
};

[[nodiscard]] VariantSummary summary_of(const VariantBench& bench);

/// The runs of each planner on all variants, as if they were on one problem.
[[nodiscard]] std::vector<PlanBench> merged_plans(const VariantBench& bench);

/// The seeds that a planner did not solve.
[[nodiscard]] std::vector<std::uint64_t> unsolved_seeds(const PlanBench& bench);

}  // namespace handway::tools
