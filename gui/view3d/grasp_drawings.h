#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "view3d/drawing.h"

#include <Eigen/Core>

#include <span>

namespace handway::gui {

/// Draws a magenta ball at each of `points` (world, m), seen through everything.
[[nodiscard]] Drawing make_contacts_node(std::span<const Eigen::Vector3d> points);

/// Draws how a grasp holds an object: at each contact a dot and the friction cone, whose axis
/// points out of the object, and from the object's centre an arrow for the force, and a ring with
/// an arrow for the torque, that together are resisted least.
/// @param X_WO of the object. @param p_O the object's centre (m), in its frame.
[[nodiscard]] Drawing make_grasp_node(const geometric::Pose& X_WO, const Eigen::Vector3d& p_O,
                                      const planning::Pregrasp& grasp, double friction);

/// Draws the forces of the hand on an object as arrows that end at their contacts, 15 mm for each
/// newton, up to 90 mm.
[[nodiscard]] Drawing make_forces_node(std::span<const planning::ContactForce> forces);

}  // namespace handway::gui
