#pragma once

#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/collision_sampling.h"
#include "handway/geometric/setup/robot_setup.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace handway::tools {

/// Findings about a robot from its tree, its shapes and random postures.
struct RobotReport {
  std::shared_ptr<const geometric::RobotModel> model;
  geometric::GroupProposal groups;
  geometric::SelfCollisionSamples sampled;
  std::vector<geometric::RobotFinding> findings;
};

[[nodiscard]] RobotReport robot_report(std::shared_ptr<const geometric::RobotModel> model,
                                       geometric::GroupProposal groups, int samples,
                                       std::uint64_t seed);

/// Prints the findings on standard output, each with a line for its correction.
void print_findings(const RobotReport& report);

/// A list of objects with `found` and `mend`.
[[nodiscard]] nlohmann::ordered_json findings_json(const RobotReport& report);

}  // namespace handway::tools
