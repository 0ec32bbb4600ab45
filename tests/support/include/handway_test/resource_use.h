#pragma once

#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

#include <cstddef>

/// Resources of the machine that a program uses.
namespace handway::test {

/// Freed memory that AddressSanitizer holds back by default, MB.
#ifdef HANDWAY_SANITIZED
constexpr std::size_t kQuarantineMegabytes = 256;
#else
constexpr std::size_t kQuarantineMegabytes = 0;
#endif

/// Programs that this one starts report no leaks: for those that unload libraries (MPI, OpenGL
/// drivers) before LeakSanitizer can name them.
inline void ignore_leaks_of_children() { ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1); }

/// The most memory that this process has had resident so far, bytes.
[[nodiscard]] inline std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// Returns the processor time of this thread so far, s; time of other programs is not included.
/// @param clock CLOCK_PROCESS_CPUTIME_ID: all threads together.
[[nodiscard]] inline double cpu_seconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace handway::test
