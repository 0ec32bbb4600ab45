#include "handway/planning/campaigns/campaign.h"

#include "handway/planning/core/parameter.h"

namespace handway::planning {

std::vector<RunSpec> Campaign::runs() const {
  std::vector<RunSpec> runs;
  runs.reserve(run_count());
  for (const std::uint64_t seed : seeds) {
    for (int problem = 0; problem < static_cast<int>(problems.size()); ++problem) {
      for (int planner = 0; planner < static_cast<int>(planners.size()); ++planner) {
        runs.push_back({problem, planner, seed});
      }
    }
  }
  return runs;
}

std::unique_ptr<Planner> make_planner(const CampaignPlanner& entry,
                                      const PlannerRegistry& registry) {
  std::unique_ptr<Planner> planner = registry.create(entry.planner);
  const std::vector<Parameter> parameters = planner->parameters();
  for (const auto& [key, value] : entry.parameters) {
    set_from_text(find_parameter(parameters, key), value);
  }
  return planner;
}

}  // namespace handway::planning
