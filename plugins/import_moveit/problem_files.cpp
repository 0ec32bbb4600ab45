#include "problem_files.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::import_moveit {
namespace {

using geometric::Pose;
using geometric::YamlElement;

constexpr double kUnitTolerance = 0.01;
constexpr double kSmallest = 1e-6;  // norm of a quaternion

Remarks*& innermost() {
  thread_local Remarks* remarks = nullptr;
  return remarks;
}

}  // namespace

Remarks::Remarks() : outer_(std::exchange(innermost(), this)) {}

Remarks::~Remarks() { innermost() = outer_; }

std::vector<std::string> Remarks::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [kind, place] : kinds_) {
    const auto& [where, count] = place;
    warnings.push_back(count == 1 ? fmt::format("{}: {}", where, kind)
                                  : fmt::format("{} and {} more: {}", where, count - 1, kind));
  }
  return warnings;
}

void remark(const std::string& kind, const std::string& where) {
  if (innermost() != nullptr) {
    ++innermost()->kinds_.try_emplace(kind, where, 0).first->second.second;
  }
}

Eigen::Quaterniond read_rotation(const YamlElement& element) {
  Eigen::Vector4d q;  // x, y, z, w
  if (element.is_list()) {
    q = element.numbers(4);
  } else {
    element.allow_keys({"x", "y", "z", "w"});
    q = {element.number_or("x", 0.0), element.number_or("y", 0.0), element.number_or("z", 0.0),
         element.number_or("w", 0.0)};
  }
  if (q.norm() < kSmallest) {
    remark("orientations of zeros, which were never filled in, are taken for the identity",
           element.where());
    return Eigen::Quaterniond::Identity();
  }
  if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
    remark("quaternions of another length than 1 are normalised", element.where());
  }
  q.normalize();
  return {q[3], q[0], q[1], q[2]};
}

Eigen::Vector3d read_point(const YamlElement& element) {
  if (element.is_list()) {
    return element.numbers(3);
  }
  element.allow_keys({"x", "y", "z"});
  return {element.number_or("x", 0.0), element.number_or("y", 0.0), element.number_or("z", 0.0)};
}

Pose read_pose(const YamlElement& element) {
  element.allow_keys({"position", "orientation"});
  Pose X = Pose::Identity();
  if (const auto orientation = element.find("orientation")) {
    X.linear() = read_rotation(*orientation).toRotationMatrix();
  }
  if (const auto position = element.find("position")) {
    X.translation() = read_point(*position);
  }
  return X;
}

std::map<std::string, double> read_joint_state(const YamlElement& element) {
  std::map<std::string, double> values;
  const std::optional<YamlElement> names = element.find("name");
  if (!names) {
    return values;
  }
  const std::vector<YamlElement> items = names->items();
  const YamlElement list = element.need("position");
  const std::vector<YamlElement> positions = list.items();
  if (items.size() != positions.size()) {
    list.refuse(fmt::format("{} positions", positions.size()),
                fmt::format("{}, one for each name", items.size()));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    values[items[i].text()] = positions[i].number();
  }
  return values;
}

Pose read_transform(const YamlElement& element) {
  Pose X = Pose::Identity();
  if (const auto rotation = element.find("rotation")) {
    X.linear() = read_rotation(*rotation).toRotationMatrix();
  }
  if (const auto translation = element.find("translation")) {
    X.translation() = read_point(*translation);
  }
  return X;
}

std::map<std::string, Pose> read_multi_dof_joint_state(const YamlElement& element) {
  std::map<std::string, Pose> poses;
  const std::optional<YamlElement> names = element.find("joint_names");
  if (!names) {
    return poses;
  }
  const std::vector<YamlElement> items = names->items();
  const YamlElement list = element.need("transforms");
  const std::vector<YamlElement> transforms = list.items();
  if (items.size() != transforms.size()) {
    list.refuse(fmt::format("{} transforms", transforms.size()),
                fmt::format("{}, one for each name", items.size()));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    poses[items[i].text()] = read_transform(transforms[i]);
  }
  return poses;
}

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
