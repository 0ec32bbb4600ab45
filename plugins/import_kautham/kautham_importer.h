#pragma once

#include "handway/planning/extensions/plugin.h"

namespace handway::import_kautham {

/// Imports problems (`.xml`) and robots (`.rob`) of Kautham 2013, with meshes in Open Inventor or
/// VRML 1.
class KauthamImporter final : public planning::Importer {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] bool can_read(const std::filesystem::path& file) const override;
  [[nodiscard]] planning::SceneState read(const std::filesystem::path& file) const override;
};

}  // namespace handway::import_kautham
