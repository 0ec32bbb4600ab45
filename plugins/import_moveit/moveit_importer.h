#pragma once

#include "handway/planning/core/importer.h"

namespace handway::import_moveit {

/// Problems of MoveIt: a planning scene and a motion plan request as YAML files.
class MoveitImporter final : public planning::Importer {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] bool can_read(const std::filesystem::path& file) const override;
  [[nodiscard]] planning::LoadedScene read(const std::filesystem::path& file) const override;
};

}  // namespace handway::import_moveit
