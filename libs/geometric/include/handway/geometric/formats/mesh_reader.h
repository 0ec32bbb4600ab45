#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>

namespace handway::geometric {

/// Reads the triangles of a mesh file: STL, OBJ, DAE, PLY, glTF and every other format of assimp;
/// Open Inventor and VRML (.iv, .wrl).
///
/// All parts of the file are put together in its root frame. Polygons are
/// triangulated, equal vertices joined, triangles without area dropped; points
/// and lines are left out. Coordinates are multiplied by `scale` per axis; a
/// mirroring scale keeps the surface facing outwards.
///
/// Units and axes: numbers are taken as metres, in the file's axes. For a DAE
/// file the `unit` is applied, and `up_axis` is not, as ROS tools do, so that
/// a robot looks the same in both. glTF is Y-up by definition and read as
/// such.
///
/// A mesh is read once: a second call for the same file (by canonical path, size and time of
/// change) and scale returns the same object as long as it is in use. May be called from any
/// thread.
///
/// @param referenced_by the place that names the file, for messages ("robot.urdf:12"). Coordinates
/// are read in single precision: rounded by 6e-8 of the largest.
///
/// @throws InputError if the file is missing, can't be read, has no triangle,
/// or has a vertex that is not finite or so far from the origin (166 m) that
/// rounding moves it by more than 0.01 mm; if a scale is zero or not finite.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const TriangleMesh> read_mesh(
    const std::filesystem::path& file, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
    const std::string& referenced_by = "");

/// Returns whether the file's name has an extension of a mesh format of read_mesh(). Open Inventor
/// and VRML are excluded: their units are those of the robot or problem that names the file.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_mesh_file(const std::filesystem::path& file);

}  // namespace handway::geometric
