#include "info_command.h"

#include "exit_codes.h"
#include "handway/geometric/collision/make_checker.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/plugin.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace handway::tools {
namespace {

using geometric::RobotModel;

std::size_t triangle_count(const std::vector<geometric::LinkGeometry>& geometry) {
  std::size_t count = 0;
  for (const geometric::LinkGeometry& part : geometry) {
    count += tessellate(part.shape)->triangles.size();
  }
  return count;
}

void print_robot(const geometric::RobotInstance& robot) {
  const RobotModel& model = *robot.model;
  std::size_t visual = 0;
  std::size_t collision = 0;
  for (int i = 0; i < model.link_count(); ++i) {
    visual += triangle_count(model.link(i).visual);
    collision += triangle_count(model.link(i).collision);
  }
  fmt::print("robot {}: {} links, {} independent joints, {} visual and {} collision triangles\n",
             robot.name, model.link_count(), model.variable_count(), visual, collision);
  fmt::print("  {:<18} {:>10} {:>10} {:>10}  {}\n", "joint", "lower", "upper", "max speed",
             "coupled to");
  for (int i = 1; i < model.link_count(); ++i) {
    const geometric::Joint& joint = model.joint(i);
    if (joint.type == geometric::JointType::kFixed) {
      continue;
    }
    const bool turns = joint.type == geometric::JointType::kRevolute;
    const auto shown = [&](double value) {
      return turns ? geometric::degrees(value) : geometric::millimetres(value);
    };
    fmt::print("  {:<18} {:>10.2f} {:>10.2f} {:>10.1f}  {} {}\n", joint.name,
               shown(joint.limits.lower), shown(joint.limits.upper), shown(joint.limits.velocity),
               joint.mimic ? joint.mimic->joint : "", turns ? "(deg)" : "(mm)");
  }
  for (const geometric::JointGroup& group : model.description().groups) {
    fmt::print("  group {}: {} joints\n", group.name, group.joints.size());
  }
  for (const std::string& warning : model.description().warnings) {
    fmt::print("  warning: {}\n", warning);
  }
}

void print_basis(const sampling::PmdBasis& basis) {
  fmt::print("basis for {}: {} joints, {} free, {} principal directions ({})\n", basis.hand,
             basis.joints.size(), basis.free_joints.size(), basis.directions.size(), basis.source);
}

void print_query(const planning::LoadedScene& loaded) {
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  const auto checker = problem.checker->clone();
  for (const auto& [which, q] :
       {std::pair("start", &problem.start), std::pair("goal", &problem.goal)}) {
    const auto touching = geometric::find_collisions(*checker, *q);
    if (touching.empty()) {
      const geometric::NamedPair closest = geometric::find_clearance(*checker, *q);
      fmt::print("{}: free, closest {} with {} at {:.3f} mm\n", which, closest.a, closest.b,
                 geometric::millimetres(closest.distance));
    }
    for (const geometric::NamedPair& pair : touching) {
      fmt::print("{}: IN COLLISION, {} with {}\n", which, pair.a, pair.b);
    }
  }
  fmt::print("pairs of bodies that are checked: {}\n", checker->world().pairs().size());
}

int info(const std::filesystem::path& file) {
  planning::Extensions extensions;
  extensions.load_plugins(planning::plugin_directory());
  const planning::LoadedScene loaded = planning::load_scene(file, extensions);
  const geometric::Scene& scene = *loaded.scene;
  fmt::print("{}\n", scene.name.empty() ? file.string() : scene.name);
  if (!scene.description.empty()) {
    fmt::print("{}\n", scene.description);
  }
  for (const geometric::RobotInstance& robot : scene.robots) {
    print_robot(robot);
  }
  for (const geometric::SceneObject& object : scene.objects) {
    fmt::print("object {}: {}, {} triangles{}\n", object.name, shape_name(object.shape),
               tessellate(object.shape)->triangles.size(),
               object.attachment ? ", carried by " + object.attachment->link : "");
  }
  if (loaded.basis) {
    print_basis(*loaded.basis);
  }
  if (scene.start && scene.goal) {
    print_query(loaded);
  }
  for (const std::string& warning : scene.warnings) {
    fmt::print("warning: {}\n", warning);
  }
  for (const planning::RefusedPlugin& plugin : extensions.refused()) {
    fmt::print("warning: plugin {} was not loaded: {}\n", plugin.file.string(), plugin.reason);
  }
  return kDone;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("info", "Show what a scene or robot file holds");
  command->add_option("file", *file, "Scene, problem or robot file")->required();
  command->callback([file, &exit_code] { exit_code = info(*file); });
}

}  // namespace handway::tools
