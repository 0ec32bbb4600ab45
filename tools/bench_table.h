#pragma once

#include "bench_report.h"
#include "handway/report/rendering/text.h"
#include "plan_bench.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace handway::tools {

/// Prints a benchmark to standard output as two tables, row by row as results come.
class BenchTable {
 public:
  /// @param files all scenes, whose names set the width of the first column.
  BenchTable(const BenchSettings& settings, const std::vector<std::filesystem::path>& files);

  void begin_collisions() const;
  void add_collision(const SceneBench& scene) const;
  void begin_plans() const;
  /// The scene's plan number `i`.
  void add_plan(const SceneBench& scene, std::size_t i) const;

  /// Measures of the motions of all plans that found a path.
  void add_motions(const std::vector<SceneBench>& scenes) const;

  /// Lines about planners on variants.
  void begin_variants(const VariantSettings& variants) const;
  void add_variants(const VariantBench& bench) const;
  /// Summary of all problems.
  void add_summary(const VariantSummary& summary) const;

 private:
  void add_faults(const PlanBench& bench) const;

  BenchSettings settings_;
  report::TextTable collisions_;
  report::TextTable plans_;
  report::TextTable motions_;
  report::TextTable variants_;
};

}  // namespace handway::tools
