#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string>
#include <vector>

/// @file
/// The library of robots, objects and hand bases that ships with the program, and its names in
/// files.
namespace handway::geometric {

/// The folder of `robots/`, `objects/`, `bases/` and so on: $HANDWAY_RESOURCE_DIR if
/// set; else `resources` or `share/handway/resources` in the folder of the running
/// program, or of this library, or one above; else that of the source tree of the
/// build.
/// @throws InputError if it does not exist, or the variable names a missing one.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path resource_dir();

/// A part of the library, with the rule from its names to files.
enum class ResourceKind {
  kRobot,      ///< "x" is robots/x/x.urdf.
  kObject,     ///< "x" or "x.stl" is objects/x.stl (or .obj, .dae, .ply, .glb, .gltf).
  kHandBasis,  ///< "x" is bases/x.yaml.
};

/// Names in the library, sorted; empty if the library has no such folder.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> resource_names(ResourceKind kind);

/// The file meant by `reference`: an absolute path; a path relative to `folder`; or, if there is no
/// such file, a name in the library; or else a file whose name differs in case (existing_file()).
/// Absolute and normal.
/// @param folder of the file that holds the reference.
/// @param referenced_by "FILE:LINE" of it, for messages.
/// @throws InputError if there is no such file, with the places searched.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path find_resource(
    ResourceKind kind, const std::filesystem::path& reference, const std::filesystem::path& folder,
    const std::string& referenced_by = "");

/// The shortest reference that find_resource() resolves to `file` from `folder`:
/// a name in the library, a relative path for files in the folder or up to two
/// levels above it, the absolute path otherwise.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path resource_reference(
    ResourceKind kind, const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace handway::geometric
