#include "model/document/new_scene.h"

#include "handway/geometric/io/resources.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <algorithm>
#include <utility>

namespace handway::gui {

using geometric::ResourceKind;

planning::LoadedScene new_scene(const std::string& robot, const planning::Extensions& extensions) {
  const planning::LoadedScene loaded = planning::load_scene(
      geometric::find_resource(ResourceKind::kRobot, robot, geometric::resource_dir()), extensions);
  geometric::Scene scene = *loaded.scene;
  scene.name.clear();
  scene.file.clear();
  scene.robots.front().file = robot;
  std::shared_ptr<const sampling::PmdBasis> basis = loaded.basis;
  for (const std::string& name : geometric::resource_names(ResourceKind::kHandBasis)) {
    if (basis) {
      break;
    }
    sampling::PmdBasis candidate = sampling::read_pmd_basis(
        geometric::find_resource(ResourceKind::kHandBasis, name, geometric::resource_dir()));
    const bool fits = std::ranges::all_of(candidate.joints, [&](const std::string& joint) {
      return scene.robots.front().model->find_variable(joint).has_value();
    });
    if (fits) {
      basis = std::make_shared<const sampling::PmdBasis>(std::move(candidate));
      scene.hand_basis = name;
    }
  }
  return {std::make_shared<const geometric::Scene>(std::move(scene)), basis};
}

}  // namespace handway::gui
