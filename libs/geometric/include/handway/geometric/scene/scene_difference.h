#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <optional>
#include <vector>

namespace handway::geometric {

/// Returns whether both have the same kind and size; meshes also the same triangles.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool same_shape(const Shape& a, const Shape& b);

/// Change of one fixed object in the world.
struct ObjectChange {
  enum class Kind { kMoved, kRemoved, kAdded };

  Kind kind = Kind::kMoved;
  SceneObject object;  ///< The object afterwards, or before if it is removed.
};

/// Difference of two scenes as far as collisions go, with the same robots and attached objects.
struct SceneDifference {
  /// Changes in order. An object of another shape is removed, and added at the end.
  std::vector<ObjectChange> changes;
  bool other_constraints = false;
  bool other_group = false;  ///< True if other joints move.
  /// True if the changes leave the objects in the order of the later scene.
  bool keeps_order = true;

  [[nodiscard]] bool empty() const { return changes.empty() && !other_constraints; }
};

/// Returns the difference from `before` to `after`; nothing if robots, attached
/// objects or allowed collisions differ. The configuration of the first robot does not
/// matter.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<SceneDifference> scene_difference(
    const Scene& before, const Scene& after);

/// Applies the change to the scene's objects. @pre an object to move or remove exists.
HANDWAY_GEOMETRIC_EXPORT void apply(const ObjectChange& change, Scene& scene);

}  // namespace handway::geometric
