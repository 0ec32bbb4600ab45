#pragma once

/// What the command line's exit codes mean (docs/command-line.md).
namespace handway::tools {

inline constexpr int kDone = 0;
inline constexpr int kNoPath = 1;  ///< No path within the limits, or a path not valid.
inline constexpr int kWrongUsage = 2;
inline constexpr int kInvalidInput = 3;
inline constexpr int kInvalidQuery = 4;   ///< Start or goal in collision or out of limits.
inline constexpr int kMotionStopped = 5;  ///< A robot's motion did not come to its end.

}  // namespace handway::tools
