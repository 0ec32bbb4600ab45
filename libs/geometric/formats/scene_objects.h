#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>

namespace handway::geometric {

/// `{xyz: […], rpy_deg: […]}`, both optional.
[[nodiscard]] Pose pose_of(const YamlElement& element);

/// find_resource(), and a warning if the file has other letters than the scene.
[[nodiscard]] std::filesystem::path find_noted(ResourceKind kind, const YamlElement& reference,
                                               const std::filesystem::path& folder, Scene& scene);

/// One entry of a scene file's `objects`.
/// @param scene with its robots, which the object may be attached to.
/// @param folder of the scene file.
[[nodiscard]] SceneObject object_of(const YamlElement& element, const Scene& scene,
                                    const std::filesystem::path& folder);

/// What the same entry says to the window.
[[nodiscard]] ObjectDisplay display_of(const YamlElement& element);

}  // namespace handway::geometric
