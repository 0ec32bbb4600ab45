#include "planners/search.h"

#include "handway/planning/core/planning_problem.h"

#include <algorithm>

namespace handway::planning {

Search::~Search() = default;

std::optional<PlanStatus> Search::advance(const SearchBudget& budget) {
  const std::optional<PlanStatus> end = spend(budget);
  report_refusals();
  return end;
}

bool Search::sample_free(const Configuration& q) {
  const std::optional<int> pair = context_.validator().collision(q);
  if (pair) {
    note_refusal(*pair, q);
  }
  return !pair;
}

bool Search::edge_plausible(const Configuration& from, const Configuration& to, int count) {
  const std::optional<int> pair = context_.validator().edge_probe(from, to, count);
  if (pair) {
    note_refusal(*pair, 0.5 * (from + to));
  }
  return !pair;
}

void Search::note_refusal(int pair, const Configuration& q) {
  refusals_.resize(static_cast<std::size_t>(context_.problem().checker->world().check_count()));
  ++refusals_[static_cast<std::size_t>(pair)];
  const double tenth = 10.0 * arm_progress(context_.problem(), q);
  ++refusals_by_tenth_.at(std::min<std::size_t>(9, static_cast<std::size_t>(tenth)));
}

// Names are looked up here and not for each refusal.
void Search::report_refusals() {
  if (refusals_.empty()) {
    return;
  }
  const geometric::CollisionWorld& world = context_.problem().checker->world();
  for (std::size_t pair = 0; pair < refusals_.size(); ++pair) {
    if (refusals_[pair] > 0) {
      const geometric::NamedPair bodies = named_pair(world, static_cast<int>(pair), 0.0);
      statistics().rejections[{bodies.a, bodies.b}] += refusals_[pair];
      refusals_[pair] = 0;
    }
  }
  auto& tenths = statistics().rejections_per_tenth;
  tenths.resize(refusals_by_tenth_.size());
  for (std::size_t i = 0; i < tenths.size(); ++i) {
    tenths[i] += refusals_by_tenth_.at(i);
  }
  refusals_by_tenth_.fill(0);
}

std::optional<PlanStatus> Search::spend(const SearchBudget& budget) {
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
