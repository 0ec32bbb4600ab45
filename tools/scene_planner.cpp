#include "scene_planner.h"

#include <CLI/CLI.hpp>

#include <vector>

namespace handway::tools {

std::unique_ptr<planning::Planner> scene_planner(const std::string& name,
                                                 const geometric::PlannerChoice& choice,
                                                 const planning::PlannerRegistry& registry) {
  const std::string taken = !name.empty()          ? name
                            : !choice.name.empty() ? choice.name
                                                   : registry.names().front();
  std::unique_ptr<planning::Planner> planner = registry.create(taken);
  using planning::PlannerRegistry;
  const bool same =
      PlannerRegistry::current_name(taken) == PlannerRegistry::current_name(choice.name);
  if (same || choice.name.empty()) {
    const std::vector<planning::Parameter> parameters = planner->parameters();
    for (const auto& [key, value] : choice.settings) {
      set_from_text(find_parameter(parameters, key), value);
    }
  }
  return planner;
}

void apply_settings(planning::Planner& planner, const std::vector<std::string>& settings) {
  const std::vector<planning::Parameter> parameters = planner.parameters();
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw CLI::ValidationError("--set", "\"" + setting + "\" is not KEY=VALUE");
    }
    set_from_text(find_parameter(parameters, setting.substr(0, equals)),
                  setting.substr(equals + 1));
  }
}

}  // namespace handway::tools
