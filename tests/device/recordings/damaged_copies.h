#pragma once

#include <cstddef>
#include <string>

namespace handway::test {

/// Passes damaged copies of a file's content: cut off at every seventh byte, then with each byte
/// changed in turn.
template <typename Take>
void for_damaged_copies(const std::string& valid, const Take& take) {
  for (std::size_t size = 0; size < valid.size(); size += 7) {
    take(valid.substr(0, size));
  }
  for (std::size_t at = 0; at < valid.size(); ++at) {
    std::string damaged = valid;
    damaged[at] = static_cast<char>(damaged[at] ^ (at % 2 == 0 ? 0xFF : 0x01));
    take(damaged);
  }
}

}  // namespace handway::test
