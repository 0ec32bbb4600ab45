#pragma once

#include <cstddef>

namespace handway::geometric {

/// The type of a number in a binary file.
struct BinaryNumber {
  char kind = 'f';        ///< f: IEEE 754, i: signed, u: unsigned integer.
  std::size_t bytes = 4;  ///< Size of the number.
  bool big_endian = false;

  /// Returns whether there is such a number: f of 2, 4 or 8 bytes, i and u of 1, 2, 4 or 8.
  [[nodiscard]] bool is_known() const;
  /// The number whose bytes begin at `at`. @pre is_known().
  [[nodiscard]] double value(const char* at) const;
};

}  // namespace handway::geometric
