#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <filesystem>
#include <memory>
#include <string>

namespace handway::planning {

/// What a scene file gives: the scene and, where the format has one, the hand's basis.
struct LoadedScene {
  std::shared_ptr<const geometric::Scene> scene;
  std::shared_ptr<const sampling::PmdBasis> basis;  ///< Null: none.
};

/// Reads problems or robots of a foreign format.
class HANDWAY_PLANNING_EXPORT Importer {
 public:
  virtual ~Importer() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Looks at the name and the first bytes; must not throw on any readable file.
  [[nodiscard]] virtual bool can_read(const std::filesystem::path& file) const = 0;
  /// @throws InputError naming file, element, what was found and expected.
  [[nodiscard]] virtual LoadedScene read(const std::filesystem::path& file) const = 0;
};

}  // namespace handway::planning
