#pragma once

namespace handway::test {

/// Returns the number of cases for a test of random ones: `count` times $HANDWAY_TEST_SCALE
/// (default 1), a tenth of that under AddressSanitizer, at least 1.
/// @throws std::runtime_error if the variable is no number above 0.
[[nodiscard]] int scaled(int count);

}  // namespace handway::test
