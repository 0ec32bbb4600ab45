#pragma once

#include <string>

namespace handway::test {

/// Exit code of a motion that was stopped before its end.
inline constexpr int kMotionStopped = 5;

/// A shipped scene to send a path of.
[[nodiscard]] std::string scene();

/// A path of the scene (CSV), planned once.
[[nodiscard]] const std::string& planned_path();

/// The number that follows `words` (a regular expression) in `text`; 1e9 if there is none.
[[nodiscard]] double number_after(const std::string& text, const std::string& words);

}  // namespace handway::test
