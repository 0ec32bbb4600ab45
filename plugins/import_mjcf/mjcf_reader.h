#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <filesystem>

namespace handway::import_mjcf {

/// Returns whether the file's name ends in .xml or .mjcf, and it begins like an MJCF file.
[[nodiscard]] bool is_mjcf_file(const std::filesystem::path& file);

/// Reads a robot from an MJCF file (https://mujoco.readthedocs.io/en/2.2.2/XMLreference.html), by
/// MuJoCo's own compiler, with includes and defaults.
///
/// - The root link is the "world"; a body is a link of its name. Of several joints of a body, all
///   but the last carry links BODY/JOINT without shape.
/// - Joints have MuJoCo's values; hinges without a range are continuous, slides without one go ±2
///   m, balls are three rotations (JOINT/yaw, /pitch, /roll), free joints floating bases.
/// - Geometries that can be in contact collide, by their own triangles in place of MuJoCo's
///   convex hull; those of the visible groups (0 to 2) are drawn. Planes and height fields are left
///   out.
/// - Pairs of bodies that MuJoCo does not check may touch: a body and its parent, those of
///   `exclude`, and those whose masks are disjoint.
/// - Linear equalities of joints and of fixed tendons become couplings.
/// - Key frames become postures. Actuators, sites, sensors and other equalities are ignored.
/// @throws InputError with MuJoCo's message if it refuses the file.
[[nodiscard]] geometric::RobotDescription read_mjcf(const std::filesystem::path& file);

}  // namespace handway::import_mjcf
