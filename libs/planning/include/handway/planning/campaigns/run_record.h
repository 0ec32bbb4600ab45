#pragma once

#include "handway/planning/campaigns/campaign.h"

#include <cstdint>
#include <string>
#include <vector>

namespace handway::planning {

/// What one run of a campaign came to. Apart from the times, the same campaign gives the
/// same records, whatever the machine was doing, unless a run ended at its time limit.
struct RunRecord {
  RunSpec spec;
  bool solved = false;
  std::string status;  ///< As to_string(PlanStatus); "refused" if the planner couldn't begin.
  std::string reason;  ///< One sentence.

  double time_s = 0.0;       ///< Planning alone, wall clock.
  double smoothing_s = 0.0;  ///< Wall clock.
  double sampling_s = 0.0;   ///< Of the roadmap planners, wall clock.
  double connection_s = 0.0;

  std::uint64_t samples = 0;  ///< Statistics as in PlanStatistics.
  std::uint64_t nodes = 0;
  std::uint64_t edges = 0;
  std::uint64_t passes = 0;
  std::uint64_t max_trials = 0;
  double final_rho_a = 0.0;
  std::vector<std::uint64_t> nodes_per_pmds;  ///< Index: number of PMDs.
  std::uint64_t node_checks = 0;
  std::uint64_t edge_checks = 0;
  std::uint64_t edges_tested = 0;

  std::uint64_t path_nodes = 0;  ///< 0: no path.
  double path_length = 0.0;      ///< In joints normalised to [0, 1]; 0: no path.
  double resolution_mm = 0.0;    ///< Of the certificate.
  double min_clearance_mm = 0.0;
  std::uint64_t certificate_checks = 0;
  std::string path;  ///< As to_csv(); empty: no path.
};

}  // namespace handway::planning
