#include "formats/urdf_mesh_files.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/package_path.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

// Returns "Write filename="…"" if such a file is nearby, else `otherwise`.
std::string mesh_advice(const std::string& filename, const fs::path& folder,
                        const std::string& otherwise) {
  const fs::path file = with_slashes(filename);
  std::optional<fs::path> found = find_file_below(folder, file);
  found = found ? found : find_file_below(folder.parent_path(), file);
  return found ? "Write filename=\"" + found->lexically_relative(folder).generic_string() +
                     "\": there is a file of this name"
               : otherwise;
}

// Finds a file by the end of its name in the robot's folder or the one above, for robots that were
// copied out of their package, or whose package was renamed.
std::optional<fs::path> find_nearby(const std::string& filename, const fs::path& folder) {
  const fs::path whole = with_slashes(filename);
  for (auto begin = whole.begin(); begin != whole.end(); ++begin) {
    fs::path end;
    std::for_each(begin, whole.end(), [&](const fs::path& part) { end /= part; });
    for (const fs::path& top : {folder, folder.parent_path()}) {
      const fs::path file = existing_file(top / end.relative_path());
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) {
        return file;
      }
    }
  }
  return std::nullopt;
}

/// Resolves a mesh's `filename` in a robot file (see read_urdf()).
/// @param folder of the robot file, absolute.
/// @param referenced_by "FILE:LINE", for messages.
/// @throws InputError if a package is not found or the scheme is unknown.
fs::path resolve_mesh_filename(const std::string& filename, const fs::path& folder,
                               const std::string& referenced_by) {
  const std::size_t colon = filename.find("://");
  if (colon == std::string::npos) {
    return existing_file((folder / filename).lexically_normal());
  }
  const std::string scheme = filename.substr(0, colon);
  const std::string rest = filename.substr(colon + 3);
  if (scheme == "file") {
    return existing_file(fs::path(rest).lexically_normal());
  }
  if (scheme != "package" && scheme != "model") {
    throw MissingMeshError({referenced_by, "mesh", "\"" + filename + "\"",
                            "a relative path, file:// or package://",
                            "Copy the mesh beside the robot"});
  }
  const std::string name = rest.substr(0, rest.find('/'));
  const std::optional<fs::path> package = find_package(name, folder);
  if (!package) {
    throw MissingMeshError(
        {referenced_by, "mesh", "\"" + filename + "\", but no folder \"" + name + "\"",
         "that folder at " + folder.string() +
             " or above, or in --package-path or "
             "$ROS_PACKAGE_PATH",
         mesh_advice(filename, folder, "Put the package there, or write a relative path")});
  }
  return existing_file((*package / fs::path(rest).lexically_relative(name)).lexically_normal());
}

}  // namespace

UrdfMeshFiles::UrdfMeshFiles(const XmlDocument& document, fs::path folder)
    : document_(document),
      folder_(std::move(folder)),
      compiler_(mujoco_compiler(document.root("robot"))) {}

fs::path UrdfMeshFiles::find(const pugi::xml_node& mesh, const std::string& element) {
  const std::string filename = mesh.attribute("filename").value();
  fs::path file;
  if (std::optional<fs::path> compiled = find_by_compiler(filename)) {
    by_compiler_.insert(filename);
    file = *std::move(compiled);
  } else {
    try {
      file = find_as_written(filename, element, document_.where(mesh));
    } catch (const MissingMeshError&) {
      std::optional<fs::path> other = find_in_package_path(filename);
      other = other ? other : find_nearby(filename, folder_);
      if (!other) {
        throw;
      }
      found_.insert(filename + " is " + other->string());
      file = *std::move(other);
    }
  }
  if (differs_in_case(filename, file)) {
    renamed_.insert(filename);
  }
  return file;
}

std::vector<std::string> UrdfMeshFiles::warnings() const {
  std::vector<std::string> warnings;
  if (!renamed_.empty()) {
    warnings.push_back(fmt::format("files whose names have other letters on the disk: {}",
                                   fmt::join(renamed_, ", ")));
  }
  if (!by_compiler_.empty()) {
    warnings.push_back(fmt::format("{} mesh{} where <mujoco><compiler meshdir=\"{}\"> says",
                                   by_compiler_.size(), by_compiler_.size() == 1 ? " is" : "es are",
                                   compiler_->mesh_folder.string()));
  }
  if (std::string elsewhere = found_elsewhere(); !elsewhere.empty()) {
    warnings.push_back(std::move(elsewhere));
  }
  return warnings;
}

std::optional<UrdfMeshFiles::MujocoCompiler> UrdfMeshFiles::mujoco_compiler(
    const pugi::xml_node& robot) {
  const pugi::xml_node compiler = robot.child("mujoco").child("compiler");
  if (!compiler) {
    return std::nullopt;
  }
  const pugi::xml_attribute assets = compiler.attribute("assetdir");
  const pugi::xml_attribute meshes = compiler.attribute("meshdir");
  return MujocoCompiler{with_slashes(meshes ? meshes.value() : assets.value()),
                        std::string_view(compiler.attribute("strippath").value()) != "false"};
}

// Returns the file where MuJoCo would find it, if the URDF names MuJoCo's folder.
std::optional<fs::path> UrdfMeshFiles::find_by_compiler(const std::string& filename) const {
  if (!compiler_) {
    return std::nullopt;
  }
  const std::size_t scheme = filename.find("://");
  const fs::path written =
      with_slashes(scheme == std::string::npos ? filename : filename.substr(scheme + 3));
  const fs::path name = compiler_->strips_path ? written.filename() : written;
  fs::path file = existing_file((folder_ / compiler_->mesh_folder / name).lexically_normal());
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? std::optional(std::move(file)) : std::nullopt;
}

fs::path UrdfMeshFiles::find_as_written(const std::string& filename, const std::string& element,
                                        const std::string& where) const {
  fs::path file = resolve_mesh_filename(filename, folder_, where);
  if (!fs::exists(file)) {
    throw MissingMeshError({where, element, "no such file: " + file.string(), "a mesh",
                            mesh_advice(filename, folder_, "Check the path")});
  }
  return file;
}

std::string UrdfMeshFiles::found_elsewhere() const {
  constexpr std::size_t kMostNamed = 3;
  if (found_.empty()) {
    return "";
  }
  std::vector<std::string> named(found_.begin(), found_.end());
  const std::size_t others = named.size() - std::min(kMostNamed, named.size());
  named.resize(named.size() - others);
  return fmt::format("meshes that are not where the file says were looked for: {}{}",
                     fmt::join(named, ", "),
                     others > 0 ? fmt::format(", and {} more", others) : "");
}

void MissingMeshes::add(const InputProblem& problem, const std::string& name) {
  first_ = first_.value_or(problem);
  names_.insert(name);
}

void MissingMeshes::refuse() const {
  if (!first_) {
    return;
  }
  InputProblem problem = *first_;
  if (names_.size() > 1) {
    problem.found += fmt::format(" ({} collision meshes are missing in all)", names_.size());
  }
  throw MissingMeshError(problem);
}

}  // namespace handway::geometric
