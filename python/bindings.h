#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <stop_token>
#include <string>

/// The parts of the module handway._core.

namespace handway::python {

/// InputError, a ValueError with the pieces of its sentence as attributes.
void bind_input_errors(pybind11::module_& module);

/// Basis, FreeJoint, read_basis().
void bind_basis(pybind11::module_& module);

/// Result, Certificate, PathCheck.
void bind_results(pybind11::module_& module);

/// Scene, load_scene().
void bind_scene(pybind11::module_& module);

/// new_scene(), and functions that make other scenes of a Scene. @pre bind_scene()
void bind_editing(pybind11::module_& module);

/// Motion, find_pmds(), Scene.time(), Scene.grasps(). @pre bind_scene(), bind_basis()
void bind_motion(pybind11::module_& module);

/// calibrate_camera(), calibrate_camera_by_points().
void bind_calibration(pybind11::module_& module);

/// movement_smoothness(), motion_distance(), Scene.measure_motion(). @pre bind_scene()
void bind_likeness(pybind11::module_& module);

/// Connection, Emulator, map_recording(), Scene.connect(), Scene.emulate(). @pre bind_motion()
void bind_devices(pybind11::module_& module);

/// Planner, Parameter, planner(), planners(), plugins(), refused_plugins().
void bind_planner(pybind11::module_& module);

/// TaskPlan, TaskStage, Planner.plan_task(). @pre bind_planner(), bind_scene()
void bind_tasks(pybind11::module_& module);

/// Runs `work` in a thread of its own without the interpreter's lock, so that other Python threads
/// continue, and checks for signals meanwhile: Ctrl-C stops the work and raises KeyboardInterrupt.
/// Exceptions of `work` are passed on.
/// @pre the caller holds the lock.
void run_interruptible(const std::function<void(std::stop_token)>& work);

/// Warns a Python program (UserWarning). @throws pybind11::error_already_set if it takes warnings
/// for errors. @pre the caller holds the lock.
void warn(const std::string& sentence);

}  // namespace handway::python
