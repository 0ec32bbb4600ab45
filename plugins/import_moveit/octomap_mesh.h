#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <memory>

namespace handway::import_moveit {

/// The occupied cells of an octomap_msgs/Octomap as one closed surface: the sides of these boxes
/// without an occupied neighbour, m, in the map's frame. Free and unknown cells are free, as in
/// MoveIt. Both forms of the message are read, `binary` and with probabilities (OcTree and
/// ColorOcTree).
/// @returns null for a map without data or without occupied cells.
/// @throws InputError if liboctomap can't read it, or it has more than 2 million free sides.
[[nodiscard]] std::shared_ptr<const geometric::TriangleMesh> octomap_mesh(
    const geometric::YamlElement& octomap);

}  // namespace handway::import_moveit
