#include "handway/geometric/io/package_path.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/text_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
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

/// Folders added while the program runs.
struct AddedFolders {
  std::mutex mutex;
  std::vector<fs::path> folders;
};

AddedFolders& added_folders() {
  static AddedFolders added;
  return added;
}

void append_folders(const char* variable, const char* below, std::vector<fs::path>& folders) {
  const char* value = std::getenv(variable);
  std::istringstream paths(value != nullptr ? value : "");
  for (std::string path; std::getline(paths, path, ':');) {
    if (!path.empty()) {
      folders.push_back((fs::absolute(path) / below).lexically_normal());
    }
  }
}

// Returns the folders that the user has named, the last first.
std::vector<fs::path> package_path() {
  AddedFolders& added = added_folders();
  const std::scoped_lock lock(added.mutex);
  std::vector<fs::path> folders(added.folders.rbegin(), added.folders.rend());
  append_folders("HANDWAY_PACKAGE_PATH", "", folders);
  return folders;
}

std::vector<fs::path> package_roots() {
  std::vector<fs::path> roots = package_path();
  append_folders("ROS_PACKAGE_PATH", "", roots);
  append_folders("AMENT_PREFIX_PATH", "share", roots);
  return roots;
}

// Counts equal parts of the paths, from their ends.
std::ptrdiff_t common_end(const fs::path& a, const fs::path& b) {
  const std::vector<fs::path> one(a.begin(), a.end());
  const std::vector<fs::path> other(b.begin(), b.end());
  return std::distance(one.rbegin(),
                       std::mismatch(one.rbegin(), one.rend(), other.rbegin(), other.rend()).first);
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

// Searches folders of another name whose manifest has the name, such as downloads with the name of
// a branch: `folder`, its parents, and folders beside these.
std::optional<fs::path> find_by_manifest(const std::string& name, const fs::path& folder) {
  constexpr int kMostParents = 6;
  constexpr int kMostEntries = 200;
  int parents = 0;
  for (fs::path above = folder; above.has_relative_path() && parents < kMostParents;
       above = above.parent_path(), ++parents) {
    if (package_name_of(above) == name) {
      return above;
    }
    std::vector<fs::path> beside;
    std::error_code error;
    int entries = 0;
    for (fs::directory_iterator entry(above, fs::directory_options::skip_permission_denied, error),
         end;
         !error && entry != end && ++entries < kMostEntries; entry.increment(error)) {
      if (package_name_of(entry->path()) == name) {
        beside.push_back(entry->path());
      }
    }
    if (!beside.empty()) {
      return *std::ranges::min_element(beside);  // entries come in any order
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
  if (!found) {
    found = find_near(name, folder, Letters::kAnyCase);
  }
  return found ? found : find_by_manifest(name, folder);
}

std::string package_name_of(const fs::path& folder) {
  constexpr std::string_view kBegin = "<name>";
  const fs::path manifest = folder / "package.xml";
  std::error_code error;
  if (!fs::is_regular_file(manifest, error)) {
    return "";
  }
  const std::string text = head_of(manifest);
  const std::size_t begin = text.find(kBegin);
  const std::size_t end = begin == std::string::npos ? begin : text.find("</name>", begin);
  if (end == std::string::npos) {
    return "";
  }
  std::istringstream words(text.substr(begin + kBegin.size(), end - begin - kBegin.size()));
  std::string name;
  words >> name;
  return name;
}

void add_package_path(const fs::path& folder) {
  AddedFolders& added = added_folders();
  const std::scoped_lock lock(added.mutex);
  added.folders.push_back(fs::absolute(folder).lexically_normal());
}

std::optional<fs::path> find_file_below(const fs::path& top, const fs::path& file) {
  constexpr int kDepth = 5;
  constexpr int kMostEntries = 20'000;
  constexpr auto kOptions = fs::directory_options::skip_permission_denied;
  std::optional<fs::path> best;
  int entries = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(top, kOptions, error), end;
       !error && entry != end && ++entries < kMostEntries; entry.increment(error)) {
    if (entry.depth() >= kDepth) {
      entry.disable_recursion_pending();
    }
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.filename() != file.filename() || !entry->is_regular_file(ignored)) {
      continue;
    }
    const auto ends_alike = best ? common_end(*best, file) : 0;
    const auto alike = common_end(path, file);
    // The file system determines the order of a folder's entries.
    if (alike > ends_alike || (alike == ends_alike && path < *best)) {
      best = path;
    }
  }
  return best;
}

std::optional<fs::path> find_in_package_path(const fs::path& file) {
  for (const fs::path& folder : package_path()) {
    if (std::optional<fs::path> found = find_file_below(folder, file)) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace handway::geometric
