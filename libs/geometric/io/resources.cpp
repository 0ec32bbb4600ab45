#include "handway/geometric/io/resources.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

bool is_library(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "robots", ignored);
}

// The binary that contains this code: other programs, such as Python, load it.
fs::path own_binary() {
  Dl_info info{};
  const bool found = dladdr(reinterpret_cast<const void*>(&is_library), &info) != 0;
  return found && info.dli_fname != nullptr ? fs::path(info.dli_fname) : fs::path();
}

std::optional<fs::path> library_near(const fs::path& binary) {
  std::error_code error;
  fs::path folder = fs::canonical(binary, error).parent_path();
  while (!error && folder.has_relative_path()) {
    for (const char* place : {"resources", "share/handway/resources"}) {
      if (is_library(folder / place)) {
        return folder / place;
      }
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::optional<fs::path> find_library() {
  if (const char* given = std::getenv("HANDWAY_RESOURCE_DIR")) {
    if (!is_library(given)) {
      throw InputError({"HANDWAY_RESOURCE_DIR", "", "\"" + std::string(given) + "\"",
                        "a folder that holds \"robots\"", "Correct the variable or unset it"});
    }
    return given;
  }
  for (const fs::path& binary : {fs::path("/proc/self/exe"), own_binary()}) {
    if (std::optional<fs::path> found = library_near(binary)) {
      return found;
    }
  }
  const fs::path built = HANDWAY_RESOURCES_OF_SOURCE_TREE;
  return is_library(built) ? std::optional(built) : std::nullopt;
}

// The folder for one kind; empty without a library.
fs::path library_folder(ResourceKind kind) {
  static constexpr std::array<const char*, 3> kFolders = {"robots", "objects", "bases"};
  const std::optional<fs::path> library = find_library();
  return library ? fs::absolute(*library / kFolders[static_cast<std::size_t>(kind)]) : fs::path();
}

// Returns candidate paths of a name of the library, best first; empty without a library.
std::vector<fs::path> library_places(ResourceKind kind, const fs::path& name) {
  const fs::path folder = library_folder(kind);
  if (folder.empty()) {
    return {};
  }
  if (kind == ResourceKind::kRobot) {
    return {folder / name / (name.filename().string() + ".urdf")};
  }
  if (kind == ResourceKind::kHandBasis) {
    return {folder / (name.string() + ".yaml")};
  }
  std::vector<fs::path> places = {folder / name};
  for (const char* extension : {".stl", ".obj", ".dae", ".ply", ".glb", ".gltf"}) {
    places.push_back(folder / (name.string() + extension));
  }
  return places;
}

std::optional<fs::path> try_find(ResourceKind kind, const fs::path& reference,
                                 const fs::path& folder) {
  std::error_code ignored;
  const fs::path beside = (fs::absolute(folder) / reference).lexically_normal();
  if (fs::is_regular_file(beside, ignored)) {
    return beside;
  }
  if (reference.is_absolute()) {
    return std::nullopt;
  }
  for (const fs::path& place : library_places(kind, reference)) {
    if (fs::is_regular_file(place, ignored)) {
      return place.lexically_normal();
    }
  }
  const fs::path other = existing_file(beside);
  return fs::is_regular_file(other, ignored) ? std::optional(other) : std::nullopt;
}

// The name that the library has for a file in it; empty if it has none.
fs::path library_name(ResourceKind kind, const fs::path& file) {
  const fs::path relative = file.lexically_relative(library_folder(kind).lexically_normal());
  if (relative.empty() || *relative.begin() == "..") {
    return {};
  }
  if (kind == ResourceKind::kRobot) {
    return relative.parent_path();
  }
  return kind == ResourceKind::kHandBasis ? fs::path(relative).replace_extension() : relative;
}

}  // namespace

fs::path resource_dir() {
  if (const std::optional<fs::path> library = find_library()) {
    return *library;
  }
  throw InputError({"resources", "", "no folder \"resources\" beside or above the program",
                    "the robots and objects that ship with it",
                    "Set HANDWAY_RESOURCE_DIR to that folder"});
}

std::vector<std::string> resource_names(ResourceKind kind) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = library_folder(kind);
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path stem = entry->path().stem();
    if (try_find(kind, stem, folder / "none")) {
      names.push_back(stem.string());
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

fs::path find_resource(ResourceKind kind, const fs::path& reference, const fs::path& folder,
                       const std::string& referenced_by) {
  if (reference.empty()) {
    throw InputError({referenced_by, "", "an empty path", "a file or a name in the library", ""});
  }
  if (const std::optional<fs::path> found = try_find(kind, reference, folder)) {
    return *found;
  }
  std::string places = (fs::absolute(folder) / reference).lexically_normal().string();
  std::string advice = "Check the path";
  if (reference.is_relative()) {
    const std::vector<fs::path> in_library = library_places(kind, reference);
    places += in_library.empty() ? "" : " or " + in_library.front().string();
    if (const std::string name = advise_name(reference.string(), resource_names(kind));
        !name.empty()) {
      advice = name;
    }
  }
  throw InputError(
      {referenced_by, "", "no file for \"" + reference.string() + "\"", places, advice});
}

fs::path resource_reference(ResourceKind kind, const fs::path& file, const fs::path& folder) {
  fs::path target = fs::absolute(file).lexically_normal();
  const fs::path from = fs::absolute(folder).lexically_normal();
  const fs::path relative = target.lexically_relative(from);
  const auto ups = std::ranges::count(relative, fs::path(".."));
  for (const fs::path& reference : {library_name(kind, target), ups <= 2 ? relative : fs::path()}) {
    if (!reference.empty() && try_find(kind, reference, from) == target) {
      return reference;
    }
  }
  return target;
}

}  // namespace handway::geometric
