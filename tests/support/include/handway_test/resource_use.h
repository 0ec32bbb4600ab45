#pragma once

#include <sys/resource.h>
#include <time.h>

#include <cstddef>

/// What a program takes of the machine.
namespace handway::test {

/// The most memory that this process has had resident so far, bytes.
[[nodiscard]] inline std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// What this thread has had of a core so far, s; what other programs take does not count.
/// @param clock CLOCK_PROCESS_CPUTIME_ID: all threads together.
[[nodiscard]] inline double cpu_seconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace handway::test
