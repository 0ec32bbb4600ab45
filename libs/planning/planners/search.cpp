#include "planners/search.h"

namespace handway::planning {

Search::~Search() = default;

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
