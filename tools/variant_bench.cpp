#include "variant_bench.h"

#include <algorithm>
#include <limits>

namespace handway::tools {
namespace {

template <typename Value>
void append_to(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

VariantSummary& VariantSummary::operator+=(const VariantSummary& other) {
  pairs += other.pairs;
  solved_by_any += other.solved_by_any;
  solved_by_default += other.solved_by_default;
  append_to(missed, other.missed);
  return *this;
}

double VariantSummary::default_share() const {
  return solved_by_any > 0
             ? static_cast<double>(solved_by_default) / static_cast<double>(solved_by_any)
             : std::numeric_limits<double>::quiet_NaN();
}

VariantSummary summary_of(const VariantBench& bench) {
  VariantSummary summary;
  for (const VariantRuns& runs : bench.variants) {
    if (runs.plans.empty()) {
      continue;
    }
    const PlanBench& own = runs.plans.front();
    for (std::size_t i = 0; i < own.results.size(); ++i) {
      ++summary.pairs;
      if (own.results[i].solved()) {
        ++summary.solved_by_any;
        ++summary.solved_by_default;
        continue;
      }
      MissedPair missed{
          bench.file.string(), runs.variant.number, own.seeds[i], own.results[i].reason, {}};
      for (std::size_t p = 1; p < runs.plans.size(); ++p) {
        const PlanBench& other = runs.plans[p];
        const auto run = std::ranges::find(other.seeds, missed.seed) - other.seeds.begin();
        if (run < std::ssize(other.results) &&
            other.results[static_cast<std::size_t>(run)].solved()) {
          missed.solved_by.emplace_back(other.planner,
                                        other.results[static_cast<std::size_t>(run)].time_s);
        }
      }
      summary.solved_by_any += missed.solved_by.empty() ? 0 : 1;
      summary.missed.push_back(std::move(missed));
    }
  }
  return summary;
}

std::vector<PlanBench> merged_plans(const VariantBench& bench) {
  std::vector<PlanBench> merged;
  for (const VariantRuns& runs : bench.variants) {
    for (std::size_t p = 0; p < runs.plans.size(); ++p) {
      if (p == merged.size()) {
        merged.push_back(runs.plans[p]);
        continue;
      }
      append_to(merged[p].seeds, runs.plans[p].seeds);
      append_to(merged[p].results, runs.plans[p].results);
      append_to(merged[p].path_nodes, runs.plans[p].path_nodes);
      append_to(merged[p].qualities, runs.plans[p].qualities);
      append_to(merged[p].path_faults, runs.plans[p].path_faults);
      merged[p].memory = std::max(merged[p].memory, runs.plans[p].memory);
    }
  }
  return merged;
}

std::vector<std::uint64_t> unsolved_seeds(const PlanBench& bench) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < bench.results.size(); ++i) {
    if (!bench.results[i].solved()) {
      seeds.push_back(bench.seeds[i]);
    }
  }
  return seeds;
}

}  // namespace handway::tools
