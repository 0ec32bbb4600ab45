#include "handway/planning/tasks/task_file.h"

#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using geometric::YamlElement;

constexpr const char* kStartPosture = "start";

/// Makes a task of the steps of programs.
class TaskMaker {
 public:
  /// @param source of the steps, for messages.
  TaskMaker(const geometric::Scene& scene, std::string source)
      : scene_(scene), source_(std::move(source)) {}

  Task make(const std::vector<geometric::ProgramStep>& steps) {
    append(steps);
    return std::move(task_);
  }

  template <typename Step>
  void operator()(const Step& step) {
    task_.emplace_back(step);
  }
  void operator()(const geometric::PostureStep& step) {
    task_.emplace_back(move_to_posture(scene_, step.posture, source_));
  }
  void operator()(const geometric::AlternativesStep& step) {
    const std::size_t index = task_.size();
    task_.emplace_back(FirstOfStep{{}, geometric::to_string(step)});
    std::vector<std::size_t> lengths;
    for (const geometric::Program& program : step.programs) {
      const std::size_t before = task_.size();
      append(program.steps);
      if (task_.size() > before) {  // else all of its steps are disabled
        lengths.push_back(task_.size() - before);
      }
    }
    if (lengths.empty()) {
      task_.pop_back();
    } else {
      std::get<FirstOfStep>(task_[index]).lengths = std::move(lengths);
    }
  }

 private:
  void append(const std::vector<geometric::ProgramStep>& steps) {
    for (const geometric::ProgramStep& step : steps) {
      if (!step.disabled) {
        std::visit(*this, step);
      }
    }
  }

  const geometric::Scene& scene_;
  std::string source_;
  Task task_;
};

Task task_of(const std::vector<geometric::ProgramStep>& steps, const geometric::Scene& scene,
             const std::string& source) {
  return TaskMaker(scene, source).make(steps);
}

// The postures of the scene, and then those of its first robot.
std::vector<geometric::NamedPosture> postures_of(const geometric::Scene& scene) {
  std::vector<geometric::NamedPosture> postures = scene.postures;
  std::ranges::copy(scene.robots.front().model->description().postures,
                    std::back_inserter(postures));
  return postures;
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

std::vector<std::string> posture_names(const geometric::Scene& scene) {
  std::vector<std::string> names{kStartPosture};
  for (const geometric::NamedPosture& posture : postures_of(scene)) {
    if (std::ranges::count(names, posture.name) == 0) {
      names.push_back(posture.name);
    }
  }
  return names;
}

MoveStep move_to_posture(const geometric::Scene& scene, const std::string& name,
                         const std::string& source) {
  const geometric::RobotInstance& robot = scene.robots.front();
  MoveStep move{scene.start.value_or(robot.configuration), name};
  if (name == kStartPosture) {
    return move;
  }
  const std::vector<geometric::NamedPosture> postures = postures_of(scene);
  const auto found = std::ranges::find(postures, name, &geometric::NamedPosture::name);
  if (found == postures.end()) {
    throw geometric::InputError({source, "move", "\"" + name + "\"",
                                 "start, or a posture of the scene or its robot",
                                 geometric::advise_name(name, posture_names(scene))});
  }
  for (const auto& [joint, value] : found->values) {
    if (const auto v = robot.model->find_variable(joint)) {
      move.q[*v] = value;
    }
  }
  return move;
}

}  // namespace handway::planning
