#include "arrays.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace py = pybind11;

namespace handway::python {
namespace {

std::string shape_of(const Array& array) {
  std::string text;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    text += (axis == 0 ? "" : ", ") + std::to_string(array.shape(axis));
  }
  return "shape [" + text + "]";
}

Eigen::VectorXd finite_row(const double* begin, Eigen::Index width, const std::string& argument) {
  Eigen::VectorXd row = Eigen::Map<const Eigen::VectorXd>(begin, width);
  for (Eigen::Index i = 0; i < width; ++i) {
    if (!std::isfinite(row[i])) {
      throw geometric::InputError(
          {argument, fmt::format("entry {}", i), fmt::format("{}", row[i]), "a finite number", ""});
    }
  }
  return row;
}

}  // namespace

std::string file_name_from(const py::object& path, const std::string& argument) {
  const auto text =
      py::reinterpret_steal<py::object>(PyOS_FSPath(path.ptr()));  // TypeError if it is none
  if (!text) {
    throw py::error_already_set();
  }
  std::string name = py::isinstance<py::bytes>(text)
                         ? std::string(py::reinterpret_borrow<py::bytes>(text))
                         : std::string(py::str(py::module_::import("os").attr("fspath")(text)));
  if (name.empty() || name.find('\0') != std::string::npos) {
    throw geometric::InputError({argument, "", name.empty() ? "an empty name" : "a name with a NUL",
                                 "the name of a file", ""});
  }
  return name;
}

Batch batch_from(const Array& array, Eigen::Index width, const std::string& argument) {
  const bool fits = (array.ndim() == 1 || array.ndim() == 2) &&
                    array.shape(array.ndim() - 1) == static_cast<py::ssize_t>(width);
  if (!fits) {
    throw geometric::InputError(
        {argument, "", shape_of(array), fmt::format("shape [{}] or [n, {}]", width, width), ""});
  }
  Batch batch;
  batch.is_single = array.ndim() == 1;
  const py::ssize_t rows = batch.is_single ? 1 : array.shape(0);
  batch.rows.reserve(static_cast<std::size_t>(rows));
  for (py::ssize_t row = 0; row < rows; ++row) {
    const std::string name = batch.is_single ? argument : fmt::format("{}[{}]", argument, row);
    batch.rows.push_back(finite_row(array.data() + row * width, width, name));
  }
  return batch;
}

Eigen::VectorXd vector_from(const Array& array, Eigen::Index width, const std::string& argument) {
  if (array.ndim() != 1 || array.shape(0) != static_cast<py::ssize_t>(width)) {
    throw geometric::InputError(
        {argument, "", shape_of(array), fmt::format("shape [{}]", width), ""});
  }
  return finite_row(array.data(), width, argument);
}

py::array_t<double> to_array(const std::vector<Eigen::VectorXd>& rows, Eigen::Index width) {
  py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{width}});
  double* out = array.mutable_data();
  for (const Eigen::VectorXd& row : rows) {
    out = std::copy_n(row.data(), width, out);
  }
  return array;
}

py::array_t<double> to_array(const Eigen::VectorXd& vector) {
  return py::array_t<double>(py::ssize_t{vector.size()}, vector.data());
}

py::object to_answer(const Batch& batch, const std::vector<Eigen::VectorXd>& rows,
                     Eigen::Index width) {
  return batch.is_single ? py::object(to_array(rows.front())) : py::object(to_array(rows, width));
}

}  // namespace handway::python
