#include "chosen_basis.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <filesystem>
#include <memory>

namespace handway::tools {

void choose_basis(std::vector<std::string>& settings, planning::LoadedScene& scene) {
  const std::string key = "basis=";
  for (const std::string& setting : settings) {
    if (!setting.starts_with(key)) {
      continue;
    }
    const std::filesystem::path file =
        geometric::find_resource(geometric::ResourceKind::kHandBasis, setting.substr(key.size()),
                                 std::filesystem::current_path(), "--set basis");
    auto basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
    if (scene.basis && scene.basis->hand != basis->hand) {
      throw geometric::InputError({file.string(), "hand", basis->hand, scene.basis->hand,
                                   "The scene's robot has another hand"});
    }
    scene.basis = std::move(basis);
  }
  std::erase_if(settings, [&](const std::string& setting) { return setting.starts_with(key); });
}

}  // namespace handway::tools
