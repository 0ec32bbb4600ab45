#pragma once

#include "arrays.h"
#include "scene_model.h"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

/// Where links of a scene's robot are brought to, and how they move. InputError if shapes differ, a
/// number is not finite or there is no such link.
namespace handway::python {

/// Configurations that bring `link` to X_WL [4, 4], at most `most`, the nearest to `near` first:
/// [n, variables]. @param free only such in which the robot is free.
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

/// Goal poses: one, a list, or None.
[[nodiscard]] std::vector<geometric::PoseGoal> goal_poses_from(const pybind11::object& goals);

/// PoseGoal.
void bind_pose_goal(pybind11::module_& module);

}  // namespace handway::python
