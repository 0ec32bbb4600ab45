#pragma once

namespace handway::test {

/// The longest that a window test waits for what must come, however busy the machine.
#ifdef HANDWAY_SANITIZED
inline constexpr int kPatienceMs = 240000;
#else
inline constexpr int kPatienceMs = 60000;
#endif

}  // namespace handway::test
