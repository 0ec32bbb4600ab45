#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/geometric/scene/scene.h"

namespace handway::geometric {

/// One entry of a scene file's `constraints`.
/// @param scene with its robots and objects, which the constraint may be about.
[[nodiscard]] PathConstraint constraint_of(const YamlElement& element, const Scene& scene);

}  // namespace handway::geometric
