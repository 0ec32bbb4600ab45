#pragma once

#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Arrays in NumPy's format .npy, versions 1 to 3.
/// Source: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

namespace handway::geometric {

/// The largest number of elements of an array that is read.
inline constexpr std::size_t kMostNumpyElements = std::size_t{1} << 27;

/// Header of an array.
struct HANDWAY_GEOMETRIC_EXPORT NumpyHeader {
  char kind = 'f';             ///< NumPy's letter: f, i, u, b (Boolean), U or S (text).
  std::size_t item_bytes = 8;  ///< Bytes of an element.
  bool big_endian = false;
  bool fortran_order = false;  ///< The first index runs fastest.
  std::vector<std::size_t> shape;
  std::string problem;  ///< Reason why the elements can't be read; empty if they can.

  [[nodiscard]] bool is_text() const { return kind == 'U' || kind == 'S'; }
  /// NumPy's name of the type, as "float32".
  [[nodiscard]] std::string type_name() const;
  /// Bytes of all elements. @pre there is no problem.
  [[nodiscard]] std::size_t bytes() const;
};

/// Bytes of magic, version and length, from which numpy_header_bytes() is known.
inline constexpr std::size_t kNumpyPreamble = 12;

/// Returns whether bytes begin as an array does.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_numpy(std::string_view head);

/// Bytes in front of the elements.
/// @param head the first kNumpyPreamble bytes, or all of a shorter file.
/// @throws InputError naming `source` if this is no array, of an unknown version, or the header is
/// longer than 1 MB.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::size_t numpy_header_bytes(std::string_view head,
                                                                      const std::string& source);

/// Parses a header. Arrays of objects and of records have a problem.
/// @param header the first numpy_header_bytes() of the file.
/// @throws InputError naming `source` if it is damaged.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT NumpyHeader parse_numpy_header(std::string_view header,
                                                                      const std::string& source);

/// Header and elements of a whole file.
struct NumpyContent {
  NumpyHeader header;
  std::string_view elements;  ///< With its bytes(), or empty if the header has a problem.
};

/// Splits the content of a file.
/// @throws InputError naming `source` if the header is damaged, or elements are missing.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT NumpyContent split_numpy(std::string_view content,
                                                                const std::string& source);

/// The elements, shape [first dimension, product of the others in C order].
/// @pre the header has no problem and no text, and `elements` has its bytes().
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Eigen::MatrixXd numpy_numbers(const NumpyHeader& header,
                                                                     std::string_view elements);

/// The texts of an array in the order of its elements, as UTF-8.
/// @pre the header is of text without a problem, and `elements` has its bytes().
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> numpy_words(
    const NumpyHeader& header, std::string_view elements);

}  // namespace handway::geometric
