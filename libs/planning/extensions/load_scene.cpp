#include "handway/planning/extensions/load_scene.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/alike_lines.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/extensions/plugin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

using geometric::ResourceKind;

SceneState read_own_format(const fs::path& file) {
  geometric::Scene scene = geometric::read_scene(file);
  std::shared_ptr<const sampling::PmdBasis> basis;
  if (!scene.hand_basis.empty()) {
    basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(
        geometric::find_resource(ResourceKind::kHandBasis, scene.hand_basis,
                                 fs::absolute(file).parent_path(), file.string())));
  }
  return {std::make_shared<const geometric::Scene>(std::move(scene)), std::move(basis)};
}

SceneState scene_of_robot(const fs::path& file, const geometric::XacroArguments& arguments) {
  const fs::path path = fs::absolute(file).lexically_normal();
  geometric::RobotInstance robot;
  robot.model = geometric::load_robot(path, arguments);
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
  if (geometric::has_extension(file, ".srdf")) {
    advice = "An SRDF is read with the URDF of the same name beside it: name that";
  }
  for (const RefusedPlugin& plugin : plugins.refused()) {
    advice += fmt::format("{}{} was not loaded: {}", advice.empty() ? "" : "; ",
                          plugin.file.filename().string(), plugin.reason);
  }
  throw geometric::InputError(
      {file.string(), "", "a file of no known format", formats, std::move(advice)});
}

SceneState read_any(const fs::path& file, const PluginManager& plugins,
                    const geometric::XacroArguments& arguments) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    const std::vector<std::string> robots = geometric::resource_names(ResourceKind::kRobot);
    if (std::ranges::find(robots, file.string()) != robots.end()) {
      return scene_of_robot(
          geometric::find_resource(ResourceKind::kRobot, file, geometric::resource_dir()),
          arguments);
    }
    const bool is_there = fs::exists(file, error);
    throw geometric::InputError({file.string(), "",
                                 fs::is_directory(file, error) ? "a folder"
                                 : is_there                    ? "no regular file"
                                                               : "no such file",
                                 "a scene or robot file, or the name of a robot of the library",
                                 is_there ? "" : geometric::advise_name(file.string(), robots)});
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
    return scene_of_robot(file, arguments);
  }
  refuse(file, plugins);
}

/// Returns whether an object has this name, or that of a further shape of it ("cell_2").
bool is_called(const std::string& object, const std::string& name) {
  const std::size_t digits = object.find_last_not_of("0123456789");
  return object == name || (object.starts_with(name + "_") && digits == name.size());
}

// Makes the objects named in $HANDWAY_HOLLOW, one per line, hollow.
void hollow_out(geometric::Scene& scene) {
  const char* hollow = std::getenv("HANDWAY_HOLLOW");
  std::istringstream names(hollow != nullptr ? hollow : "");
  for (std::string name; std::getline(names, name);) {
    bool is_there = name.empty();
    std::vector<std::string> objects;
    for (geometric::SceneObject& object : scene.objects) {
      objects.push_back(object.name);
      if (is_called(object.name, name)) {
        object.solid = false;
        is_there = true;
      }
    }
    if (!is_there) {
      throw geometric::InputError({"--hollow " + name, "", "no object of that name",
                                   "an object of the scene",
                                   geometric::advise_name(name, objects)});
    }
  }
}

// Refuses arguments that no robot was read with.
void check_used(geometric::XacroArguments arguments, const fs::path& file,
                const geometric::Scene& scene) {
  arguments.merge(geometric::xacro_arguments_of_environment());
  const auto takes_arguments = [](const std::shared_ptr<const geometric::RobotModel>& model) {
    return !model->description().xacro_arguments.empty();
  };
  const bool is_used =
      std::ranges::any_of(scene.robots, [&](const geometric::RobotInstance& robot) {
        return takes_arguments(robot.model) ||
               std::ranges::any_of(robot.parts, takes_arguments, &geometric::RobotPart::model);
      });
  if (!arguments.empty() && !is_used) {
    throw geometric::InputError(
        {file.string(), "",
         "the xacro argument \"" + arguments.begin()->first + "\", and no xacro file that takes it",
         "a robot file called *.xacro, or a scene with one", ""});
  }
}

}  // namespace

SceneState load_scene(const fs::path& file, const PluginManager& plugins,
                      const geometric::XacroArguments& arguments) {
  SceneState loaded = read_any(file, plugins, arguments);
  check_used(arguments, file, *loaded.scene);
  auto scene = std::make_shared<geometric::Scene>(*loaded.scene);
  scene->warnings = geometric::merged_alike(scene->warnings);
  hollow_out(*scene);
  loaded.scene = std::move(scene);
  return loaded;
}

}  // namespace handway::planning
