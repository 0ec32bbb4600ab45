#pragma once

#include <functional>

namespace handway::test {

/// Runs tests that have to keep up with the clock. If one fails while the machine stood still for
/// a moment, as virtual ones do, that says nothing of the program: then the whole process begins
/// anew, with the same arguments, a few times at most.
/// @param argc, argv of main(), which `run_tests` may change.
/// @param run_tests what main() would do else. @returns what it returned last.
[[nodiscard]] int run_in_real_time(int argc, char** argv,
                                   const std::function<int(int argc, char** argv)>& run_tests);

}  // namespace handway::test
