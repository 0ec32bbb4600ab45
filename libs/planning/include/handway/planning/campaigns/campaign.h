#pragma once

#include "handway/planning/export.h"
#include "handway/planning/planners/planner_registry.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// Experiments: planners with their parameters on problems, once for each of many seeds.
namespace handway::planning {

/// Keys and values as text, in the order of the planner's own parameters.
using ParameterTexts = std::vector<std::pair<std::string, std::string>>;

/// A problem of a campaign.
struct CampaignProblem {
  std::string name;  ///< Unique in the campaign.
  std::filesystem::path file;
  /// What `file` refers to: robots, meshes, bases, …, itself included; empty: not known.
  std::vector<std::filesystem::path> files = {};
};

/// A planner with one value for each of its parameters.
struct CampaignPlanner {
  std::string label;          ///< Unique in the campaign, for example "pmd-prm n_a=5".
  std::string planner;        ///< As the registry calls it.
  ParameterTexts parameters;  ///< Of every parameter, defaults included.
};

/// One run of a campaign: indices into its lists.
struct RunSpec {
  int problem = 0;
  int planner = 0;
  std::uint64_t seed = 1;

  auto operator<=>(const RunSpec&) const = default;
};

/// problems × planners × seeds.
struct HANDWAY_PLANNING_EXPORT Campaign {
  std::string name;
  std::string description;
  std::vector<CampaignProblem> problems;
  std::vector<CampaignPlanner> planners;
  std::vector<std::uint64_t> seeds;  ///< Each once.
  int threads = 1;                   ///< Of a run.
  double time_limit_s = 60.0;        ///< Of a run.

  [[nodiscard]] std::size_t run_count() const {
    return problems.size() * planners.size() * seeds.size();
  }
  /// All runs: for each seed every problem, for each problem every planner, so that a
  /// campaign that is cut short has run all of them about equally often.
  [[nodiscard]] std::vector<RunSpec> runs() const;
};

/// The planner of an entry, with its parameters set.
/// @throws InputError for an unknown planner, parameter or value.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<Planner> make_planner(
    const CampaignPlanner& entry, const PlannerRegistry& registry);

}  // namespace handway::planning
