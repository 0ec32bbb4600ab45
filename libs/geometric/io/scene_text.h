#pragma once

#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {

/// How a scene file names the files that it needs, in the scene's order.
struct SceneReferences {
  std::vector<std::filesystem::path> robots;
  std::vector<bool> is_saved_robot;           ///< With its bases, in a file made for the scene.
  std::vector<std::filesystem::path> meshes;  ///< Empty for objects of other shapes.
  std::vector<bool> is_scaled;                ///< False: the mesh file already has the scale.
  std::filesystem::path hand_basis;
};

/// The text of a scene file, without comments.
[[nodiscard]] std::string scene_text(const Scene& scene, const SceneReferences& references);

}  // namespace handway::geometric
