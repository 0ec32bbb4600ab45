#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace handway::python {

/// Numbers in C order; what numpy can turn into such an array is accepted.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Rows of numbers as they came from Python: one row or a batch of them.
struct Batch {
  std::vector<Eigen::VectorXd> rows;
  bool is_single = false;  ///< The array had one dimension, and so has the answer.
};

/// @param width what a row must have: the shape is [width] or [n, width].
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

/// The same of rows: shape [n, width] or [width].
[[nodiscard]] pybind11::object to_answer(const Batch& batch,
                                         const std::vector<Eigen::VectorXd>& rows,
                                         Eigen::Index width);

}  // namespace handway::python
