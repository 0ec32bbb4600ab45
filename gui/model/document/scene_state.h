#pragma once

#include "handway/geometric/scene/scene.h"

#include <memory>
#include <string_view>

namespace handway::gui {

/// What a person edits: a scene that never changes itself. An edit makes a new
/// state of an old one.
struct SceneState {
  std::shared_ptr<const geometric::Scene> scene;

  [[nodiscard]] bool is_hidden(std::string_view object) const {
    const geometric::SceneObject* found = find(object);
    return found && found->hidden;
  }
  [[nodiscard]] bool is_locked(std::string_view object) const {
    const geometric::SceneObject* found = find(object);
    return found && found->locked;
  }
  /// nullptr if there is no such object.
  [[nodiscard]] const geometric::SceneObject* find(std::string_view object) const {
    return scene ? geometric::find_object(*scene, object) : nullptr;
  }

  friend bool operator==(const SceneState&, const SceneState&) = default;
};

}  // namespace handway::gui
