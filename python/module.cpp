#include "bindings.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/printable.h"
#include "scene_questions.h"

#include <chrono>
#include <cstring>
#include <exception>
#include <future>
#include <utility>

namespace py = pybind11;

namespace handway::python {

void bind_input_errors(py::module_& module) {
  static py::handle type =
      py::exception<geometric::InputError>(module, "InputError", PyExc_ValueError).release();
  type.attr("__doc__") =
      "Error of an input that can't be read or is invalid.\n\n"
      "The message is one sentence; its pieces are the attributes source (file and line, or\n"
      "argument), element (key, XML element or joint), found, expected and advice.";
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) {
        std::rethrow_exception(std::move(pointer));
      }
    } catch (const geometric::InputError& error) {
      py::object value = type(geometric::printable(error.what()));
      value.attr("source") = error.problem().source;
      value.attr("element") = error.problem().element;
      value.attr("found") = error.problem().found;
      value.attr("expected") = error.problem().expected;
      value.attr("advice") = error.problem().advice;
      PyErr_SetObject(type.ptr(), value.ptr());
    }
  });
}

void run_interruptible(const std::function<void(std::stop_token)>& work) {
  std::stop_source stop;
  std::future<void> done =
      std::async(std::launch::async, [&work, token = stop.get_token()] { work(token); });
  while (true) {
    {
      const py::gil_scoped_release release;
      if (done.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) {
        break;
      }
    }
    if (PyErr_CheckSignals() != 0) {
      stop.request_stop();
      const py::gil_scoped_release release;
      done.wait();
      break;
    }
  }
  if (PyErr_Occurred() != nullptr) {
    throw py::error_already_set();
  }
  done.get();
}

void warn(const std::string& sentence) {
  if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0) {
    throw py::error_already_set();
  }
}

namespace {

// Bound member functions accept None for their object, as a null pointer, unless configured
// otherwise.
void refuse_none_as_self(py::handle function) {
  if (PyInstanceMethod_Check(function.ptr())) {
    function = PyInstanceMethod_GET_FUNCTION(function.ptr());
  }
  if (!PyCFunction_Check(function.ptr())) {
    return;
  }
  PyObject* const capsule = PyCFunction_GET_SELF(function.ptr());
  if (capsule == nullptr || !PyCapsule_CheckExact(capsule)) {
    return;
  }
  auto* record = static_cast<py::detail::function_record*>(
      PyCapsule_GetPointer(capsule, PyCapsule_GetName(capsule)));
  for (; record != nullptr; record = record->next) {
    if (record->is_method && record->args.empty()) {
      record->args.emplace_back(::strdup("self"), nullptr, py::handle(), true, false);
    }
  }
}

void refuse_none_as_self_of(const py::handle& type) {
  for (const auto& [name, member] : py::dict(type.attr("__dict__"))) {
    if (py::isinstance(member, py::handle(reinterpret_cast<PyObject*>(&PyProperty_Type)))) {
      refuse_none_as_self(py::object(member.attr("fget")));
      refuse_none_as_self(py::object(member.attr("fset")));
    } else {
      refuse_none_as_self(member);
    }
  }
}

// An instance made by __new__ alone has no value. pybind11 would give it uninitialised memory on
// its first use as an argument.
void refuse_uninitialised_instances(const py::module_& module) {
  for (const auto& [name, object] : module.attr("__dict__").cast<py::dict>()) {
    if (!py::isinstance<py::type>(object)) {
      continue;
    }
    if (py::detail::type_info* info =
            py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(object.ptr()))) {
      refuse_none_as_self_of(object);
      info->operator_new = [](std::size_t) -> void* {
        throw py::type_error("the object has not been initialised: its __init__ has not run");
      };
    }
  }
}

}  // namespace
}  // namespace handway::python

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = HANDWAY_VERSION;
  handway::python::bind_input_errors(module);
  handway::python::bind_basis(module);
  handway::python::bind_pose_goal(module);
  handway::python::bind_results(module);
  handway::python::bind_planner(module);
  handway::python::bind_scene(module);
  handway::python::bind_editing(module);
  handway::python::bind_tasks(module);
  handway::python::bind_motion(module);
  handway::python::bind_likeness(module);
  handway::python::bind_calibration(module);
  handway::python::bind_devices(module);
  handway::python::refuse_uninitialised_instances(module);
}
