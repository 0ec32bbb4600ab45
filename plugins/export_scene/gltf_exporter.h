#pragma once

#include "handway/planning/extensions/scene_exporter.h"

namespace handway::export_scene {

/// Scenes as binary glTF 2.0 (`STEM.glb`), for slides and other viewers: what is seen of all robots
/// as they stand, the first one at the scene's start, and all objects that are not hidden, each a
/// node of its name. Y is up, as glTF has it; edges below 40° are shaded smoothly.
class GltfExporter final : public planning::SceneExporter {
 public:
  [[nodiscard]] std::string name() const override { return "gltf"; }
  [[nodiscard]] std::string description() const override {
    return "glTF 2.0 of the scene, for slides and viewers";
  }

 protected:
  [[nodiscard]] std::vector<std::filesystem::path> do_write(const geometric::Scene& scene,
                                                            const std::filesystem::path& folder,
                                                            const std::string& stem) const override;
};

}  // namespace handway::export_scene
