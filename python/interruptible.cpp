#include "bindings.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>

namespace py = pybind11;

namespace handway::python {

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

}  // namespace handway::python
