#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// @file
/// Sines and cosines of many angles at once, in a form that compilers turn into SIMD. Only IEEE
/// additions and multiplications: bitwise the same on every machine, which the C library does not
/// guarantee.
namespace handway::geometric {

/// Angles up to this size use the fast method; larger ones use the C library.
inline constexpr double kLargestFastAngle = 1e5;  // rad

/// The fast method for one angle; at most 2.3e-16 off the true values.
///
/// Cody-Waite reduction to [-pi/4, pi/4], then the minimax polynomials of
/// fdlibm's k_sin.c and k_cos.c (Sun Microsystems, 1993), Estrin's order.
/// @pre |angle| ≤ kLargestFastAngle.
inline void fast_sine_cosine(double angle, double& sine, double& cosine) {
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kHalfPiHigh = 1.57079632673412561417e+00;  // 33 bits: exact times small integers
  constexpr double kHalfPiLow = 6.07710050650619224932e-11;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  const double shifted = angle * kTwoOverPi + kRound;
  const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double k = shifted - kRound;
  const double r = (angle - k * kHalfPiHigh) - k * kHalfPiLow;
  const double z = r * r;
  const double zz = z * z;
  const double sine_tail = (8.33333333332248946124e-03 - 1.98412698298579493134e-04 * z) +
                           zz * ((2.75573137070700676789e-06 - 2.50507602534068634195e-08 * z) +
                                 zz * 1.58969099521155010221e-10);
  const double s = r + r * z * (-1.66666666666666324348e-01 + z * sine_tail);
  const double cosine_tail =
      (4.16666666666666019037e-02 - 1.38888888888741095749e-03 * z) +
      zz * ((2.48015872894767294178e-05 - 2.75573143513906633035e-07 * z) +
            zz * (2.08757232129817482790e-09 - 1.13596475577881948265e-11 * z));
  const double c = 1.0 - (0.5 * z - zz * cosine_tail);
  // Quadrants 1 and 3 swap the two; 2 and 3 negate the sine, 1 and 2 the cosine.
  const std::uint64_t swap = 0 - (quadrant & 1);
  const auto s_bits = std::bit_cast<std::uint64_t>(s);
  const auto c_bits = std::bit_cast<std::uint64_t>(c);
  const std::uint64_t exchanged = (s_bits ^ c_bits) & swap;
  sine = std::bit_cast<double>((s_bits ^ exchanged) ^ ((quadrant & 2) << 62));
  cosine = std::bit_cast<double>((c_bits ^ exchanged) ^ (((quadrant + 1) & 2) << 62));
}

/// sines[i], cosines[i] of angles[i], i < count; NaN where the angle is not finite.
inline void sine_cosine(const double* angles, std::size_t count, double* sines, double* cosines) {
  bool small = true;
  for (std::size_t i = 0; i < count; ++i) {
    small &= std::abs(angles[i]) <= kLargestFastAngle;
  }
  if (small) {
    for (std::size_t i = 0; i < count; ++i) {
      fast_sine_cosine(angles[i], sines[i], cosines[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    sines[i] = std::sin(angles[i]);
    cosines[i] = std::cos(angles[i]);
  }
}

}  // namespace handway::geometric
