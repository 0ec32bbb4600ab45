#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <memory>
#include <string_view>

namespace handway::planning {

/// A scene and the basis of its hand. It is immutable: an edit makes a new state of an old one.
struct SceneState {
  std::shared_ptr<const geometric::Scene> scene;
  std::shared_ptr<const sampling::PmdBasis> basis = nullptr;  ///< Null: none.

  [[nodiscard]] bool is_hidden(std::string_view object) const { return display_of(object).hidden; }
  [[nodiscard]] bool is_locked(std::string_view object) const { return display_of(object).locked; }
  [[nodiscard]] geometric::ObjectDisplay display_of(std::string_view object) const {
    return scene ? scene->display.of(object) : geometric::ObjectDisplay{};
  }
  /// Returns the object of that name; null if there is none.
  [[nodiscard]] const geometric::SceneObject* find(std::string_view object) const {
    return scene ? geometric::find_object(*scene, object) : nullptr;
  }

  friend bool operator==(const SceneState&, const SceneState&) = default;
};

}  // namespace handway::planning
