#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"

#include <filesystem>
#include <ignition/math/Pose3.hh>
#include <sdf/Geometry.hh>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_sdf {

[[nodiscard]] geometric::Pose pose_of(const ignition::math::Pose3d& pose);

/// A geometry as shapes of our own, with their poses in its frame; empty for one of another kind.
/// @param folder of the SDF file. @param where file and element, for messages.
/// @throws InputError for a mesh that can't be read.
[[nodiscard]] std::vector<std::pair<geometric::Shape, geometric::Pose>> shapes_of(
    const sdf::Geometry& geometry, const std::filesystem::path& folder, const std::string& where);

}  // namespace handway::import_sdf
