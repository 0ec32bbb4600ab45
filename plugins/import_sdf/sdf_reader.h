#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <filesystem>

namespace handway::import_sdf {

/// Reads a robot from an SDF file (http://sdformat.org/spec?ver=1.9) by libsdformat: its model, or
/// the one with the most joints of a world; models in it by their scoped names (`hand::palm`).
///
/// - Joints: fixed, revolute, continuous, prismatic, universal and revolute2 (two rotations,
///   JOINT and JOINT/2), ball (three: JOINT/yaw, /pitch, /roll). Limits beyond ±10⁶ are ignored:
///   the joint is continuous, or slides ±2 m. A joint whose frame is not its child's carries the
///   link JOINT/frame, to which the child is fixed. The link joined to the world is the root, or
///   its child.
/// - Geometries: box, capsule, cylinder, ellipsoid, mesh, sphere; others are left out. Mesh
///   files: relative to the SDF file, `file://`, or `model://NAME/…` and `package://NAME/…`,
///   see geometric::find_package(); $GZ_SIM_RESOURCE_PATH and $GAZEBO_MODEL_PATH are searched,
///   too.
/// @throws InputError with libsdformat's message if it refuses the file; for gearboxes and screws,
/// and mesh files that collide and can't be read.
[[nodiscard]] geometric::RobotDescription read_sdf(const std::filesystem::path& file);

}  // namespace handway::import_sdf
