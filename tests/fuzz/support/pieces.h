#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace handway::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Passes a stream on as a connection would: in pieces. The first byte says how long they are.
template <typename Take>
void in_pieces(const std::uint8_t* data, std::size_t size, Take&& take) {
  if (size == 0) {
    return;
  }
  const std::size_t length = data[0] == 0 ? size : data[0];
  for (Bytes rest(data + 1, size - 1); !rest.empty();
       rest = rest.subspan(std::min(length, rest.size()))) {
    take(rest.first(std::min(length, rest.size())));
  }
}

/// Fails the fuzz target unless the condition holds.
inline void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace handway::fuzz
