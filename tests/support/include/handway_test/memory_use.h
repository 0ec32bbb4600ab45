#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace handway::test {

/// The most memory that this process has had resident so far, bytes.
[[nodiscard]] inline std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace handway::test
