#include "problem_files.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/package_path.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;
using geometric::YamlElement;

constexpr int kFoldersAbove = 3;

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

bool has_key(const std::string& text, std::string_view key) {
  const std::string line = fmt::format("{}:", key);
  return text.starts_with(line) || text.find('\n' + line) != std::string::npos;
}

bool is_request(const fs::path& file) {
  return has_key(geometric::head_of(file), "goal_constraints");
}

// "scene0001.yaml" for "request0001.yaml", as existing_file() finds it; empty if the name has no
// such word.
fs::path partner(const fs::path& file, std::string_view word, std::string_view other) {
  std::string name = file.filename().string();
  const std::size_t at = name.find(word);
  if (at == std::string::npos) {
    return {};
  }
  return geometric::existing_file(file.parent_path() / name.replace(at, word.size(), other));
}

std::vector<fs::path> folders_from(const fs::path& folder) {
  std::vector<fs::path> folders = {fs::absolute(folder).lexically_normal()};
  for (int i = 0; i < kFoldersAbove; ++i) {
    folders.push_back(folders.back().parent_path());
  }
  return folders;
}

}  // namespace

bool is_moveit_file(const fs::path& file) {
  const std::string head = geometric::head_of(file);
  if (has_key(head, "handway") || has_key(head, "campaign")) {
    return false;
  }
  return has_key(head, "goal_constraints") || has_key(head, "robot_model_name");
}

ProblemFiles problem_files(const fs::path& file) {
  if (!is_request(file)) {
    const fs::path request = partner(file, "scene", "request");
    return {file, is_file(request) ? std::optional(request) : std::nullopt};
  }
  const fs::path scene = partner(file, "request", "scene");
  if (scene.empty() || !is_file(scene)) {
    throw geometric::InputError({file.string(), "", "no scene for the request beside it",
                                 scene.empty()
                                     ? "\"request\" in the name, and \"scene\" in that of the scene"
                                     : scene.filename().string(),
                                 ""});
  }
  return {scene, file};
}

fs::path robot_file(const YamlElement& name, const fs::path& folder) {
  if (const char* given = std::getenv("HANDWAY_ROBOT"); given != nullptr && *given != '\0') {
    if (!is_file(given)) {
      throw geometric::InputError({"--robot", "", fmt::format("no file {}", given),
                                   "the robot of the problem, as URDF", ""});
    }
    return fs::absolute(given).lexically_normal();
  }
  const std::string robot = name.text();
  for (const fs::path& place : folders_from(folder)) {
    for (const fs::path& in : {fs::path(), fs::path("robots")}) {
      for (const fs::path& candidate :
           {place / in / (robot + ".urdf"), place / in / robot / (robot + ".urdf")}) {
        if (const fs::path file = geometric::existing_file(candidate); is_file(file)) {
          return file;
        }
      }
    }
  }
  const std::vector<std::string> shipped =
      geometric::resource_names(geometric::ResourceKind::kRobot);
  if (std::ranges::count(shipped, robot) != 0) {
    return geometric::find_resource(geometric::ResourceKind::kRobot, robot, folder, name.where());
  }
  name.refuse(fmt::format("the robot \"{}\"", robot),
              fmt::format("{0}.urdf or robots/{0}.urdf in {1} or a folder above it, or a robot "
                          "that ships",
                          robot, fs::absolute(folder).lexically_normal().string()),
              "Name the robot's URDF with --robot FILE, its SRDF beside it, or put them there");
}

fs::path mesh_file(const YamlElement& resource, const fs::path& folder) {
  constexpr std::string_view kFile = "file://";
  constexpr std::string_view kPackage = "package://";
  const std::string text = resource.text();
  if (text.starts_with(kFile)) {
    return geometric::existing_file(text.substr(kFile.size()));
  }
  const fs::path wanted =
      fs::path(text.starts_with(kPackage) ? text.substr(kPackage.size()) : text);
  const fs::path inside = wanted.lexically_relative(*wanted.begin());
  for (const fs::path& place : folders_from(folder)) {
    if (const fs::path file = geometric::existing_file(place / wanted); is_file(file)) {
      return file;
    }
    if (const fs::path file = geometric::existing_file(place / inside);
        text.starts_with(kPackage) && is_file(file)) {
      return file;
    }
  }
  if (const std::optional<fs::path> package =
          text.starts_with(kPackage)
              ? geometric::find_package(wanted.begin()->string(), folders_from(folder).front())
              : std::nullopt) {
    if (const fs::path file = geometric::existing_file(*package / inside); is_file(file)) {
      return file;
    }
  }
  resource.refuse(fmt::format("no file {}", text),
                  "a mesh in the problem's folder or one of the three above it, or of a package in "
                  "--package-path or $ROS_PACKAGE_PATH");
}

}  // namespace handway::import_moveit
