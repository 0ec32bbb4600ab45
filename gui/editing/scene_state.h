#pragma once

#include "handway/geometric/scene/scene.h"

#include <memory>
#include <set>
#include <string>

namespace handway::gui {

/// What a person edits: a scene that never changes itself, and how its objects
/// are treated in the window. An edit makes a new state of an old one.
struct SceneState {
  std::shared_ptr<const geometric::Scene> scene;
  std::set<std::string> hidden = {};  ///< Objects that are not drawn.
  std::set<std::string> locked = {};  ///< Objects that can't be changed.

  friend bool operator==(const SceneState&, const SceneState&) = default;
};

}  // namespace handway::gui
