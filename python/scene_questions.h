#pragma once

#include "arrays.h"
#include "scene_model.h"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

/// Queries about configurations of a scene's robot; `q` has the shape [variables] or [n,
/// variables], and an answer one number, or [n]. They run without the interpreter's lock.
/// InputError if shapes differ or a number is not finite.

namespace handway::python {

/// Returns whether the robot is in collision with itself or anything else. bool.
[[nodiscard]] pybind11::object collides(const SceneModel& scene, const Array& q);

/// Distance of the closest pair, m; `enough` if it is more than that. float.
[[nodiscard]] pybind11::object clearance(const SceneModel& scene, const Array& q, double enough);

/// Returns whether every variable is within its limits. bool.
[[nodiscard]] pybind11::object within_limits(const SceneModel& scene, const Array& q);

/// Pose X_WL of a link in the world: [4, 4] or [n, 4, 4]. InputError for an unknown link.
[[nodiscard]] pybind11::array_t<double> link_pose(const SceneModel& scene, const std::string& link,
                                                  const Array& q);

/// The pairs that touch in `q` [variables]: a list of two names each.
[[nodiscard]] pybind11::list collisions(const SceneModel& scene, const Array& q);
[[nodiscard]] pybind11::list violations(const SceneModel& scene, const Array& q);

/// The closest pair in `q` [variables]: two names and the distance, m.
[[nodiscard]] pybind11::tuple closest_pair(const SceneModel& scene, const Array& q);

// Kinematics of links of a scene's robot. Functions throw InputError if shapes differ, a number is
// not finite or the link is unknown.

/// Configurations that bring `link` to X_WL [4, 4], at most `most`, the nearest to `near` first:
/// [n, variables]. @param free only configurations without collision.
[[nodiscard]] pybind11::array_t<double> inverse_kinematics(const SceneModel& scene,
                                                           const std::string& link,
                                                           const Array& X_WL,
                                                           const std::optional<Array>& near,
                                                           int most, bool free);

/// Geometric Jacobian of a link's origin in the world: [6, variables], linear rows first.
[[nodiscard]] pybind11::array_t<double> jacobian(const SceneModel& scene, const std::string& link,
                                                 const Array& q);

/// Yoshikawa's measure of the link's position: a number, or [n].
[[nodiscard]] pybind11::object manipulability(const SceneModel& scene, const std::string& link,
                                              const Array& q);

/// A pose [4, 4]. @param argument name for messages.
/// @throws InputError if it is no rigid transform.
[[nodiscard]] geometric::Pose pose_from(const Array& array, const std::string& argument);

/// Returns the matrix of a pose, [4, 4], m.
[[nodiscard]] pybind11::array_t<double> pose_array(const geometric::Pose& X);

/// Goal poses: one, a list, or None.
[[nodiscard]] std::vector<geometric::PoseGoal> goal_poses_from(const pybind11::object& goals);

/// PoseGoal.
void bind_pose_goal(pybind11::module_& module);

}  // namespace handway::python
