#include "bindings.h"
#include "scene_questions.h"

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = HANDWAY_VERSION;
  handway::python::bind_input_errors(module);
  handway::python::bind_basis(module);
  handway::python::bind_pose_goal(module);
  handway::python::bind_results(module);
  handway::python::bind_planner(module);
  handway::python::bind_scene(module);
  handway::python::bind_editing(module);
  handway::python::bind_motion(module);
  handway::python::bind_devices(module);
}
