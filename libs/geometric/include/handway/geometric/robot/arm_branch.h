#pragma once

#include <compare>

namespace handway::geometric {

/// The branch of an anthropomorphic six-axis arm's inverse kinematics, as
/// Staeubli controllers name it in their configuration flags. A posture on the
/// border between two branches counts as the first named.
struct ArmBranch {
  enum class Shoulder { kLefty, kRighty };
  enum class Bend { kPositive, kNegative };

  /// Lefty if the wrist centre is on the positive side of the shoulder plane:
  /// for the TX90, 0.425 sin q2 + 0.425 sin(q2 + q3) + 0.05 ≥ 0.
  Shoulder shoulder = Shoulder::kLefty;
  /// Sign of the elbow's bend from the stretched arm: for the TX90, of q3.
  Bend elbow = Bend::kPositive;
  /// Sign of the wrist's bend from axes 4 and 6 in line: for the TX90, of q5.
  Bend wrist = Bend::kPositive;

  // clang-tidy 14 takes the comparison with 0 inside for a null pointer.
  auto operator<=>(const ArmBranch&) const = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace handway::geometric
