#pragma once

#include "arrays.h"
#include "scene_model.h"

#include <pybind11/pybind11.h>

#include <string>

/// Questions about configurations of a scene's robot; `q` has the shape [variables] or
/// [n, variables], and an answer one number, or [n]. They are answered without the
/// interpreter's lock. InputError if shapes differ or a number is not finite.
namespace handway::python {

/// Does the robot touch itself or something else? bool.
[[nodiscard]] pybind11::object collides(const SceneModel& scene, const Array& q);

/// Distance of the closest pair, m; `enough` where it is more than that. float.
[[nodiscard]] pybind11::object clearance(const SceneModel& scene, const Array& q, double enough);

/// Is every variable within its limits? bool.
[[nodiscard]] pybind11::object within_limits(const SceneModel& scene, const Array& q);

/// Pose X_WL of a link in the world: [4, 4] or [n, 4, 4]. InputError if there is no such link.
[[nodiscard]] pybind11::array_t<double> link_pose(const SceneModel& scene, const std::string& link,
                                                  const Array& q);

/// The pairs that touch in `q` [variables]: a list of two names each.
[[nodiscard]] pybind11::list collisions(const SceneModel& scene, const Array& q);
[[nodiscard]] pybind11::list violations(const SceneModel& scene, const Array& q);

/// The closest pair in `q` [variables]: two names and the distance, m.
[[nodiscard]] pybind11::tuple closest_pair(const SceneModel& scene, const Array& q);

}  // namespace handway::python
