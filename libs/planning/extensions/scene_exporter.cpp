#include "handway/planning/extensions/scene_exporter.h"

#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/io/input_error.h"

#include <system_error>

namespace handway::planning {

std::vector<std::filesystem::path> SceneExporter::write(const geometric::Scene& scene,
                                                        const std::filesystem::path& folder) const {
  if (scene.robots.empty()) {
    throw geometric::InputError(
        {scene.file.string(), "robots", "a scene without a robot", "at least one", ""});
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw geometric::InputError({folder.string(), "", error.message(), "a folder to write to", ""});
  }
  const std::string stem = scene.file.empty() ? scene.name : scene.file.stem().string();
  return do_write(scene, folder, geometric::file_name_of(stem.empty() ? "scene" : stem));
}

}  // namespace handway::planning
