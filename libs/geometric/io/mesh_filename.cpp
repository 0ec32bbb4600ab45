#include "io/mesh_filename.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"

#include <optional>
#include <string_view>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

enum class Letters { kExact, kAnyCase };

std::optional<fs::path> find_package(const std::string& name, const fs::path& folder,
                                     Letters letters) {
  std::error_code ignored;
  for (fs::path above = folder; above.has_relative_path(); above = above.parent_path()) {
    if (above.filename() == name) {
      return above;
    }
    const fs::path beside = above / name;
    const fs::path neighbour = letters == Letters::kExact ? beside : existing_file(beside);
    if (fs::is_directory(neighbour, ignored)) {
      return neighbour;
    }
  }
  return std::nullopt;
}

}  // namespace

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
  if (scheme != "package") {
    throw InputError({referenced_by, "mesh", "\"" + filename + "\"",
                      "a relative path, file:// or package://", "Copy the mesh beside the robot"});
  }
  const std::string name = rest.substr(0, rest.find('/'));
  std::optional<fs::path> package = find_package(name, folder, Letters::kExact);
  if (!package) {
    package = find_package(name, folder, Letters::kAnyCase);
  }
  if (!package) {
    throw InputError({referenced_by, "mesh", "\"" + filename + "\", but no folder \"" + name + "\"",
                      "that folder at " + folder.string() + " or above",
                      "Put the package there, or write a relative path"});
  }
  return existing_file((*package / fs::path(rest).lexically_relative(name)).lexically_normal());
}

}  // namespace handway::geometric
