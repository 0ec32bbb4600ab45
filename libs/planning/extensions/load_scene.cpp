#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::ResourceKind;

LoadedScene read_own_format(const fs::path& file) {
  geometric::Scene scene = geometric::read_scene(file);
  std::shared_ptr<const sampling::PmdBasis> basis;
  if (!scene.hand_basis.empty()) {
    basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(
        geometric::find_resource(ResourceKind::kHandBasis, scene.hand_basis,
                                 fs::absolute(file).parent_path(), file.string())));
  }
  return {std::make_shared<const geometric::Scene>(std::move(scene)), std::move(basis)};
}

LoadedScene scene_of_robot(const fs::path& file) {
  const fs::path path = fs::absolute(file).lexically_normal();
  geometric::RobotInstance robot;
  robot.model = geometric::load_robot(path);
  robot.name = robot.model->name();
  const fs::path reference =
      geometric::resource_reference(ResourceKind::kRobot, path, path.parent_path());
  if (!reference.has_extension()) {  // the library's name; other files are named when it is saved
    robot.file = reference;
  }
  robot.configuration = robot.model->neutral();
  geometric::Scene scene;
  scene.name = robot.name;
  for (const std::string& warning : robot.model->description().warnings) {
    scene.warnings.push_back(fmt::format("robot {}: {}", robot.name, warning));
  }
  scene.robots.push_back(std::move(robot));
  return {std::make_shared<const geometric::Scene>(std::move(scene)), nullptr};
}

[[noreturn]] void refuse(const fs::path& file, const PluginManager& plugins) {
  std::string formats = "a Handway scene (.yaml), a robot (.urdf)";
  for (const auto& importer : plugins.importers()) {
    formats += ", " + importer->name();
  }
  std::string advice;
  for (const RefusedPlugin& plugin : plugins.refused()) {
    advice += fmt::format("{}{} was not loaded: {}", advice.empty() ? "" : "; ",
                          plugin.file.filename().string(), plugin.reason);
  }
  throw geometric::InputError(
      {file.string(), "", "a file of no known format", formats, std::move(advice)});
}

}  // namespace

LoadedScene load_scene(const fs::path& file, const PluginManager& plugins) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    const std::vector<std::string> robots = geometric::resource_names(ResourceKind::kRobot);
    if (std::ranges::find(robots, file.string()) != robots.end()) {
      return scene_of_robot(
          geometric::find_resource(ResourceKind::kRobot, file, geometric::resource_dir()));
    }
    throw geometric::InputError({file.string(), "",
                                 fs::exists(file, error) ? "no regular file" : "no such file",
                                 "a scene or robot file, or the name of a robot of the library",
                                 geometric::advise_name(file.string(), robots)});
  }
  for (const auto& importer : plugins.importers()) {
    if (importer->can_read(file)) {
      return importer->read(file);
    }
  }
  if (geometric::has_extension(file, ".yaml") || geometric::has_extension(file, ".yml")) {
    return read_own_format(file);
  }
  if (geometric::is_robot_file(file)) {
    return scene_of_robot(file);
  }
  refuse(file, plugins);
}

}  // namespace handway::planning
