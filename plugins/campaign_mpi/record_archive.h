#pragma once

#include "handway/planning/campaigns/campaign.h"

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

/// How runs travel between processes.
namespace boost::serialization {

template <typename Archive>
void serialize(Archive& archive, handway::planning::RunSpec& spec, unsigned /*version*/) {
  archive& spec.problem& spec.planner& spec.seed;
}

template <typename Archive>
void serialize(Archive& archive, handway::planning::RunRecord& run, unsigned /*version*/) {
  archive& run.spec& run.solved& run.status& run.reason;
  archive& run.time_s& run.smoothing_s& run.sampling_s& run.connection_s;
  archive& run.samples& run.nodes& run.edges& run.passes& run.max_trials& run.final_rho_a;
  archive& run.nodes_per_pmds& run.node_checks& run.edge_checks& run.edges_tested;
  archive& run.path_nodes& run.path_length& run.resolution_mm& run.min_clearance_mm;
  archive& run.certificate_checks& run.path;
}

}  // namespace boost::serialization
