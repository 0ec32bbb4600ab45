#pragma once

#include "bench_report.h"

namespace handway::tools {

/// Prints a benchmark to standard output as two tables, row by row as it goes on.
class BenchTable {
 public:
  /// @param files all scenes, for the width of the first column.
  BenchTable(const BenchSettings& settings, const std::vector<std::filesystem::path>& files);

  void begin_collisions() const;
  void add_collision(const SceneBench& scene) const;
  void begin_plans() const;
  /// The scene's plan number `i`.
  void add_plan(const SceneBench& scene, std::size_t i) const;

  /// Of planners on variants.
  void begin_variants(const VariantSettings& variants) const;
  void add_variants(const VariantBench& bench) const;
  /// Of all problems.
  void add_summary(const VariantSummary& summary) const;

 private:
  void add_faults(const PlanBench& bench) const;

  BenchSettings settings_;
  int width_;  ///< Of scenes' names.
};

}  // namespace handway::tools
