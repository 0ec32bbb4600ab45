#include "handway/planning/tasks/task_file.h"

#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using geometric::YamlElement;

/// @param source of the steps, for messages.
Task task_of(const std::vector<geometric::ProgramStep>& steps, const geometric::Scene& scene,
             const std::string& source) {
  Task task;
  for (const geometric::ProgramStep& step : steps) {
    if (const auto* pick = std::get_if<PickStep>(&step)) {
      task.emplace_back(*pick);
    } else if (const auto* place = std::get_if<PlaceStep>(&step)) {
      task.emplace_back(*place);
    } else {
      task.emplace_back(
          move_to_posture(scene, std::get<geometric::PostureStep>(step).posture, source));
    }
  }
  return task;
}

std::string program_names(const geometric::Scene& scene) {
  std::vector<std::string> names;
  for (const geometric::Program& program : scene.programs) {
    names.push_back("\"" + program.name + "\"");
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Task read_task(const std::filesystem::path& file, const geometric::Scene& scene) {
  const YamlElement top = YamlElement::read(file, "a task file");
  top.allow_keys({"handway_task", "steps"});
  const YamlElement version = top.need("handway_task");
  if (version.number() != kTaskVersion) {
    version.refuse(version.found(), fmt::format("version {}", kTaskVersion));
  }
  const YamlElement steps = top.need("steps");
  return task_of(geometric::program_steps_of(steps, scene), scene, steps.where());
}

Task task_of(const geometric::Program& program, const geometric::Scene& scene) {
  return task_of(program.steps, scene, scene.file.string());
}

Task program_task(const geometric::Scene& scene, const std::string& name) {
  const std::string source = scene.file.string();
  if (scene.programs.empty()) {
    throw geometric::InputError({source, "program", "no program", "a program of the scene",
                                 "Describe the steps under \"program\", or name them otherwise"});
  }
  const auto found = name.empty() && scene.programs.size() == 1
                         ? scene.programs.begin()
                         : std::ranges::find(scene.programs, name, &geometric::Program::name);
  if (found == scene.programs.end()) {
    throw geometric::InputError({source, "program",
                                 name.empty() ? "no name of a program" : "\"" + name + "\"",
                                 "one of " + program_names(scene), ""});
  }
  return task_of(*found, scene);
}

MoveStep move_to_posture(const geometric::Scene& scene, const std::string& name,
                         const std::string& source) {
  const geometric::RobotInstance& robot = scene.robots.front();
  MoveStep move{scene.start.value_or(robot.configuration), name};
  if (name == "start") {
    return move;
  }
  std::vector<geometric::NamedPosture> postures = scene.postures;
  std::ranges::copy(robot.model->description().postures, std::back_inserter(postures));
  const auto found = std::ranges::find(postures, name, &geometric::NamedPosture::name);
  if (found == postures.end()) {
    std::vector<std::string> names{"start"};
    std::ranges::transform(postures, std::back_inserter(names), &geometric::NamedPosture::name);
    throw geometric::InputError({source, "move", "\"" + name + "\"",
                                 "start, or a posture of the scene or its robot",
                                 geometric::advise_name(name, names)});
  }
  for (const auto& [joint, value] : found->values) {
    if (const auto v = robot.model->find_variable(joint)) {
      move.q[*v] = value;
    }
  }
  return move;
}

}  // namespace handway::planning
