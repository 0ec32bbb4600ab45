#include "model/document/save_scene.h"

#include "handway/geometric/io/scene_writer.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <string>

namespace handway::gui {

void save_scene(const planning::LoadedScene& loaded, const geometric::Configuration& shown,
                const geometric::PlannerChoice& planner, const std::filesystem::path& file) {
  geometric::Scene scene = *loaded.scene;
  scene.planner = planner;
  if (!scene.robots.empty()) {
    scene.robots.front().configuration = shown;
  }
  if (loaded.basis && scene.hand_basis.empty()) {
    const std::filesystem::path basis = file.parent_path() / (file.stem().string() + "_hand.yaml");
    sampling::write_pmd_basis(*loaded.basis, basis);
    scene.hand_basis = std::filesystem::absolute(basis);
  }
  geometric::write_scene(scene, file);
}

}  // namespace handway::gui
