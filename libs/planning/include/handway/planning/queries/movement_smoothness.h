#pragma once

#include "handway/planning/export.h"

#include <Eigen/Core>

#include <optional>

namespace handway::planning {

/// Speed of a movement over time, from rest to rest.
struct SpeedProfile {
  double period = 0.0;    ///< s between two samples, > 0.
  Eigen::VectorXd speed;  ///< ≥ 0, in any unit, from the first to the last sample of the movement.
};

/// Smoothness of a movement by two measures without unit, which depend on neither its size nor its
/// duration; both are negative, and nearer to 0 for a smoother movement.
struct MovementSmoothness {
  /// Log dimensionless jerk, −ln(T³ / v² ∫ s̈² dt), for the duration T, the speed s and its peak v
  /// (Hogan and Sternad, "Sensitivity of smoothness measures to movement duration, amplitude, and
  /// arrests", Journal of Motor Behavior 41, 2009; in this form with the peak speed
  /// Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of movement
  /// smoothness", Journal of NeuroEngineering and Rehabilitation 12, 2015). −ln 204.8 = −5.32 for a
  /// minimum-jerk movement; at most −ln 192 = −5.26 for a movement that begins and ends without
  /// acceleration.
  double log_dimensionless_jerk = 0.0;
  /// Spectral arc length, SPARC (the same paper of 2015): minus the length of the curve of the
  /// speed's normalised amplitude spectrum, up to the last frequency with an amplitude of 0.05, at
  /// most 10 Hz. About −1.4 for a minimum-jerk movement; stops and detours make it longer.
  double spectral_arc_length = 0.0;
};

/// Measures the smoothness of a movement; nothing for fewer than 5 samples, a speed that is 0
/// throughout, or one that is not finite. Jerk is computed by second differences of the speed,
/// which has to be smooth: a speed whose rate jumps has no finite jerk, and then the measure
/// depends on the period.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<MovementSmoothness> movement_smoothness(
    const SpeedProfile& profile);

}  // namespace handway::planning
