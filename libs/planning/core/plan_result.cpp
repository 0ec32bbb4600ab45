#include "handway/planning/core/plan_result.h"

#include <algorithm>
#include <array>

namespace handway::planning {

namespace {

void add(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& other) {
  sum.resize(std::max(sum.size(), other.size()));
  for (std::size_t i = 0; i < other.size(); ++i) {
    sum[i] += other[i];
  }
}

}  // namespace

PlanStatistics& PlanStatistics::operator+=(const PlanStatistics& other) {
  samples += other.samples;
  nodes += other.nodes;
  edges += other.edges;
  passes += other.passes;
  max_trials = std::max(max_trials, other.max_trials);
  final_rho_a = std::max(final_rho_a, other.final_rho_a);
  add(nodes_per_pmds, other.nodes_per_pmds);
  node_checks += other.node_checks;
  edge_checks += other.edge_checks;
  edges_tested += other.edges_tested;
  sampling_s += other.sampling_s;
  connection_s += other.connection_s;
  add(rejections_per_pair, other.rejections_per_pair);
  for (const auto& [pair, count] : other.rejections) {
    rejections[pair] += count;
  }
  add(rejections_per_tenth, other.rejections_per_tenth);
  return *this;
}

const char* to_string(PlanStatus status) {
  static constexpr std::array<const char*, 8> kWords = {
      "solved",     "start invalid", "goal invalid", "samples spent",
      "time limit", "cancelled",     "stalled",      "infeasible"};
  return kWords[static_cast<std::size_t>(status)];
}

}  // namespace handway::planning
