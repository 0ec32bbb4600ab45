#include "planners/search.h"

namespace handway::planning {

Search::~Search() = default;

bool Search::sample_free(const Configuration& q) {
  const std::optional<int> pair = context_.validator().collision(q);
  if (pair) {
    context_.count_rejection(*pair, arm_progress(context_.problem(), q));
  }
  return !pair;
}

bool Search::edge_plausible(const Configuration& from, const Configuration& to, int count) {
  const std::optional<int> pair = context_.validator().edge_probe(from, to, count);
  if (pair) {
    context_.count_rejection(*pair, arm_progress(context_.problem(), 0.5 * (from + to)));
  }
  return !pair;
}

std::optional<PlanStatus> Search::advance(const SearchBudget& budget) {
  const PlanStatistics& now = statistics();
  const std::uint64_t checks_before = now.checks();
  const std::uint64_t samples_before = now.samples;
  do {
    if (const auto interruption = context_.interruption()) {
      return interruption;
    }
    if (const auto end = step()) {
      return end;
    }
  } while (now.checks() - checks_before < budget.checks &&
           now.samples - samples_before < budget.samples);
  return std::nullopt;
}

}  // namespace handway::planning
