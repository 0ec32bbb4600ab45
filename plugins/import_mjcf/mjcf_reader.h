#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <filesystem>

namespace handway::import_mjcf {

/// Does the file's name end in .xml or .mjcf, and does it begin like an MJCF file?
[[nodiscard]] bool is_mjcf_file(const std::filesystem::path& file);

/// Reads a robot from an MJCF file (https://mujoco.readthedocs.io/en/2.2.2/XMLreference.html), by
/// MuJoCo's own compiler, includes and defaults among it.
///
/// - The root link is the "world"; a body is a link of its name. Of several joints of a body, all
///   but the last carry links BODY/JOINT without shape.
/// - Joints have MuJoCo's values; hinges without a range are continuous, slides without one go
///   ±2 m, balls are three turns (JOINT/yaw, /pitch, /roll), free joints floating bases.
/// - Geometries that can be in contact collide, by their own triangles where MuJoCo takes the
///   convex hull; those of the visible groups (0 to 2) are drawn. Planes and height fields are left
///   out.
/// - Pairs of bodies may touch that MuJoCo does not check: a body and its parent, those of
///   `exclude`, and those whose masks don't meet.
/// - Equalities of joints and of fixed tendons are couplings, as long as they are linear.
/// - Key frames are postures. Actuators, sites, sensors and other equalities are not read.
/// @throws InputError with MuJoCo's words if it refuses the file.
[[nodiscard]] geometric::RobotDescription read_mjcf(const std::filesystem::path& file);

}  // namespace handway::import_mjcf
