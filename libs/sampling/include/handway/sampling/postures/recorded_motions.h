#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace handway::sampling {

/// Points of a time-normalised motion.
inline constexpr Eigen::Index kMotionPoints = 50;

/// A motion of a hand from its beginning to its end, as a function of its own time from 0 to 1.
struct HandMotion {
  double begin = 0.0;  ///< s
  double end = 0.0;    ///< s
  /// Normalised joints at even times from begin to end, shape [kMotionPoints, joints].
  Eigen::MatrixXd joints;

  [[nodiscard]] double duration() const { return end - begin; }
};

/// Cuts recorded postures into motions by the speed of the hand.
///
/// Rows are resampled at 100 Hz and smoothed by a running mean over 0.1 s, twice. The speed is the
/// norm of their rate in normalised joints. A motion ends, and the next one begins, where the speed
/// has a minimum of at most half of the lower one of the highest speeds before and after it. A
/// motion then begins and ends where the speed is first and last a tenth of its highest. A motion
/// shorter than 0.2 s, longer than 5 s or within 0.1 normalised joints of its first posture is left
/// out. Where time falls or jumps by more than 0.25 s, another recording begins.
/// @param times s, shape [rows]. @param postures normalised joints, shape [rows, joints].
/// @throws std::invalid_argument if the numbers of rows differ.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::vector<HandMotion> cut_into_motions(
    const Eigen::VectorXd& times, const Eigen::MatrixXd& postures);

/// Returns the rows as one motion without rests at its ends, smoothed as by cut_into_motions();
/// nothing if the hand stays within 0.01 normalised joints of its first posture.
/// @param times s, rising, shape [rows]. @param postures normalised joints, shape [rows, joints].
/// @throws std::invalid_argument if the numbers of rows differ.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::optional<HandMotion> whole_motion(
    const Eigen::VectorXd& times, const Eigen::MatrixXd& postures);

/// Rows at `count` even times from the first to the last, by linear interpolation.
/// @param times s, never falling, shape [rows], rows ≥ 1. @param values shape [rows, columns].
/// @param count ≥ 2. @returns shape [count, columns].
/// @throws std::invalid_argument for other shapes.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::MatrixXd time_normalised(const Eigen::VectorXd& times,
                                                                      const Eigen::MatrixXd& values,
                                                                      Eigen::Index count);

}  // namespace handway::sampling
