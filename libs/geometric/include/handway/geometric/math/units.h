#pragma once

#include <numbers>

/// Conversions at the borders, of files and the screen; everything inside is SI.
namespace handway::geometric {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad per degree
inline constexpr double kMillimetre = 1e-3;                  ///< m per millimetre

[[nodiscard]] constexpr double radians(double degrees) { return degrees * kDegree; }
[[nodiscard]] constexpr double degrees(double radians) { return radians / kDegree; }
[[nodiscard]] constexpr double metres(double millimetres) { return millimetres * kMillimetre; }
[[nodiscard]] constexpr double millimetres(double metres) { return metres / kMillimetre; }

}  // namespace handway::geometric
