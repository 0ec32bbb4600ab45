#include "handway/geometric/io/package_folder.h"

#include "handway/geometric/io/existing_file.h"

#include <cstdlib>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

enum class Letters { kExact, kAnyCase };

std::optional<fs::path> find_near(const std::string& name, const fs::path& folder,
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

std::vector<fs::path> package_roots() {
  std::vector<fs::path> roots;
  for (const auto& [variable, below] :
       {std::pair("HANDWAY_PACKAGE_PATH", ""), std::pair("ROS_PACKAGE_PATH", ""),
        std::pair("AMENT_PREFIX_PATH", "share")}) {
    const char* value = std::getenv(variable);
    std::istringstream paths(value != nullptr ? value : "");
    for (std::string path; std::getline(paths, path, ':');) {
      if (!path.empty()) {
        roots.push_back((fs::absolute(path) / below).lexically_normal());
      }
    }
  }
  return roots;
}

std::optional<fs::path> find_in_roots(const std::string& name) {
  std::error_code ignored;
  for (const fs::path& root : package_roots()) {
    const fs::path itself = root.has_filename() ? root : root.parent_path();
    for (const fs::path& folder : {root / name, itself}) {
      if (folder.filename() == name && fs::is_directory(folder, ignored)) {
        return folder;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<fs::path> find_package(const std::string& name, const fs::path& folder) {
  std::optional<fs::path> found = find_near(name, folder, Letters::kExact);
  if (!found) {
    found = find_in_roots(name);
  }
  return found ? found : find_near(name, folder, Letters::kAnyCase);
}

}  // namespace handway::geometric
