#include "scene_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_file.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

void print_warning_lines(const std::vector<std::string>& warnings) {
  if (warnings.empty()) {
    return;
  }
  const std::size_t count = warnings.size();
  std::string summary = geometric::plural(count, "warning") + "\n";
  for (const std::string& warning : warnings) {
    summary += fmt::format("  warning: {}\n", warning);
  }
  print_error("handway: {}", summary);
}

struct Upright {
  std::string body;  // names may hold colons
  double degrees;
};

std::optional<Upright> upright_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  double degrees = 0.0;
  const bool good = colon != std::string::npos && colon > 0 &&
                    CLI::detail::lexical_cast(text.substr(colon + 1), degrees) && degrees > 0.0 &&
                    degrees <= 180.0;
  return good ? std::optional(Upright{text.substr(0, colon), degrees}) : std::nullopt;
}

std::string unused_name(const geometric::Scene& scene, const std::string& name) {
  std::string unused = name;
  for (int number = 2;
       std::ranges::count(scene.constraints, unused, &geometric::PathConstraint::name) > 0;
       ++number) {
    unused = name + " " + std::to_string(number);
  }
  return unused;
}

}  // namespace

void choose_basis(std::vector<std::string>& settings, planning::SceneState& scene) {
  const std::string key = "basis=";
  for (const std::string& setting : settings) {
    if (!setting.starts_with(key)) {
      continue;
    }
    const std::filesystem::path file =
        geometric::find_resource(geometric::ResourceKind::kHandBasis, setting.substr(key.size()),
                                 std::filesystem::current_path(), "--set basis");
    auto basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
    const geometric::RobotModel& model = *scene.scene->robots.front().model;
    for (const std::string& joint : basis->joints) {
      if (!geometric::find_variable_of_part(model, joint)) {
        throw geometric::InputError({file.string(), "hand", basis->hand,
                                     "a basis for the hand of " + model.name(),
                                     "The scene's robot has another hand, without joint " + joint});
      }
    }
    scene.basis = std::move(basis);
  }
  std::erase_if(settings, [&](const std::string& setting) { return setting.starts_with(key); });
}

std::unique_ptr<planning::Planner> scene_planner(const std::string& name,
                                                 const geometric::PlannerRequest& choice,
                                                 const planning::PlannerRegistry& registry) {
  const std::string taken = !name.empty()          ? name
                            : !choice.name.empty() ? choice.name
                                                   : registry.names().front();
  std::unique_ptr<planning::Planner> planner = registry.create(taken);
  using planning::PlannerRegistry;
  const bool same =
      PlannerRegistry::current_name(taken) == PlannerRegistry::current_name(choice.name);
  if (same || choice.name.empty()) {
    for (const auto& [key, value] : choice.settings) {
      planner->set_parameter(key, value);
    }
  }
  return planner;
}

void apply_settings(planning::Planner& planner, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw CLI::ValidationError("--set", "\"" + setting + "\" is not KEY=VALUE");
    }
    planner.set_parameter(setting.substr(0, equals), setting.substr(equals + 1));
  }
}

void print_warnings(const geometric::Scene& scene) { print_warning_lines(scene.warnings); }

void print_warnings(const planning::PlanningProblem& problem) {
  std::vector<std::string> warnings = problem.scene->warnings;
  warnings.insert(warnings.end(), problem.warnings.begin(), problem.warnings.end());
  print_warning_lines(warnings);
}

planning::Path read_path(const planning::PlanningProblem& problem,
                         const std::filesystem::path& file) {
  planning::JointsAtRest rest{problem.start};
  planning::Path path = planning::read_path(problem.model(), file, &rest);
  if (const std::string remark = rest.remark(file); !remark.empty()) {
    print_error("handway: {}\n", remark);
  }
  return path;
}

void add_upright_option(CLI::App& command, std::vector<std::string>& uprights) {
  command
      .add_option("--upright", uprights,
                  "Keep the z axis of an attached object or a link within DEGREES of the world's z "
                  "axis along the whole path")
      ->type_name("OBJECT:DEGREES")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check([](const std::string& text) {
        return upright_of(text) ? std::string()
                                : "\"" + text +
                                      "\" is not OBJECT:DEGREES with an angle above 0 "
                                      "and up to 180 degrees";
      });
}

void add_uprights(const std::vector<std::string>& uprights, planning::SceneState& loaded) {
  if (uprights.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  const std::vector<std::string> bodies = constrainable_bodies(scene);
  for (const std::string& text : uprights) {
    const Upright upright = upright_of(text).value();
    if (std::ranges::count(bodies, upright.body) == 0) {
      throw geometric::InputError(
          {scene.file.string(), "--upright " + text,
           upright.body + (find_object(scene, upright.body) ? ", which is not attached to a link"
                                                            : ", which is not in the scene"),
           "an object on a link of " + scene.robots.front().name + ", or one of its links",
           geometric::advise_name(upright.body, bodies)});
    }
    geometric::OrientationConstraint what;
    what.angle = geometric::radians(upright.degrees);
    scene.constraints.push_back(
        {unused_name(scene, upright.body + " upright"), upright.body, what});
  }
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

void add_group_option(CLI::App& command, std::vector<std::string>& group) {
  command
      .add_option("--group", group,
                  "Groups, robots and joints that move, instead of the scene's group; all others "
                  "stay at the start")
      ->type_name("NAME[,NAME]")
      ->delimiter(',')
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void set_group(const std::vector<std::string>& group, planning::SceneState& loaded) {
  if (group.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  geometric::set_moving_group(scene, group);
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

}  // namespace handway::tools
