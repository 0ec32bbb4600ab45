#pragma once

#include <numbers>

/// @file
/// Conversions at the borders, of files and the screen; everything inside is SI.
namespace handway::geometric {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad per degree
inline constexpr double kMillimetre = 1e-3;                  ///< m per millimetre

/// Converts degrees to radians.
[[nodiscard]] constexpr double radians(double degrees) { return degrees * kDegree; }
/// Converts radians to degrees.
[[nodiscard]] constexpr double degrees(double radians) { return radians / kDegree; }
/// Converts millimetres to metres.
[[nodiscard]] constexpr double metres(double millimetres) { return millimetres * kMillimetre; }
/// Converts metres to millimetres.
[[nodiscard]] constexpr double millimetres(double metres) { return metres / kMillimetre; }

}  // namespace handway::geometric
