#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <string>
#include <string_view>
#include <vector>

namespace handway::python {

/// Real numbers in C order; every object that numpy converts to such an array without loss other
/// than precision is accepted.
class Array
    : public pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast> {
 public:
  using array_t::array_t;
};

/// Returns the path of a file or folder: text, bytes or an os.PathLike.
/// @throws InputError naming `argument` if it is empty or has a NUL, at which the system would end
/// it; TypeError for other objects.
[[nodiscard]] std::string file_name_from(const pybind11::object& path, const std::string& argument);

/// Rows of numbers from Python: one row or a batch of them.
struct Batch {
  std::vector<Eigen::VectorXd> rows;
  bool is_single = false;  ///< The array had one dimension, as the answer will.
};

/// @param width length of a row: the shape is [width] or [n, width].
/// @param argument name for messages.
/// @throws InputError if the shape differs or a number is not finite.
[[nodiscard]] Batch batch_from(const Array& array, Eigen::Index width, const std::string& argument);

/// @throws InputError if the shape is not [width] or a number is not finite.
[[nodiscard]] Eigen::VectorXd vector_from(const Array& array, Eigen::Index width,
                                          const std::string& argument);

/// Shape [rows, width]; width of an empty list is `width`.
[[nodiscard]] pybind11::array_t<double> to_array(const std::vector<Eigen::VectorXd>& rows,
                                                 Eigen::Index width);

/// Shape [size].
[[nodiscard]] pybind11::array_t<double> to_array(const Eigen::VectorXd& vector);

/// The answers to a batch: shape [n], or the bare value if the batch is single.
template <typename Value>
[[nodiscard]] pybind11::object to_answer(const Batch& batch, const std::vector<Value>& values) {
  if (batch.is_single) {
    return pybind11::cast(values.front());
  }
  return pybind11::array_t<Value>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// Returns rows as an array: shape [n, width] or [width].
[[nodiscard]] pybind11::object to_answer(const Batch& batch,
                                         const std::vector<Eigen::VectorXd>& rows,
                                         Eigen::Index width);

}  // namespace handway::python

namespace pybind11::detail {

/// Refuses complex numbers, of which the conversion would drop the imaginary part, dates and text.
template <>
struct type_caster<handway::python::Array> {
 public:
  PYBIND11_TYPE_CASTER(handway::python::Array, const_name("numpy.ndarray[numpy.float64]"));

  bool load(handle source, bool /*convert*/) {
    const array any = array::ensure(source);
    if (!any) {
      PyErr_Clear();
      return false;
    }
    if (std::string_view("biuf").find(any.dtype().kind()) == std::string_view::npos) {
      return false;
    }
    auto numbers = array_t<double, array::c_style | array::forcecast>::ensure(any);
    if (!numbers) {
      PyErr_Clear();
      return false;
    }
    value = reinterpret_steal<handway::python::Array>(numbers.release());
    return true;
  }
};

}  // namespace pybind11::detail
