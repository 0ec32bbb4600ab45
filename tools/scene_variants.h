#pragma once

#include "handway/geometric/math/units.h"
#include "handway/planning/core/planning_problem.h"

#include <cstdint>
#include <memory>
#include <string>

namespace handway::tools {

/// Limits of variants.
inline constexpr double kMostVariantShift = 0.05;                     ///< m
inline constexpr double kMostVariantTurn = geometric::radians(25.0);  ///< rad
inline constexpr double kVariantHandGap = geometric::metres(0.3);     ///< m
inline constexpr double kLongestMovable = 0.45;                       ///< m

/// Distance of variant `number`'s (≥ 1) obstacles from the robot at the goal before the fingers
/// close, m: 24 mm of the first, 12 of the second, 2 of the twelfth.
[[nodiscard]] double variant_gap(int number);

/// A harder problem made of another one.
struct SceneVariant {
  int number = 1;                                 ///< From 1; the higher, the narrower.
  std::uint64_t seed = 1;                         ///< Seed of its random numbers.
  int draws = 0;                                  ///< Number of placements tried.
  std::shared_ptr<const geometric::Scene> scene;  ///< Null: none was found.
};

/// Makes harder problems of one. Fixed objects move, each or each group separately, unless they
/// are `locked`, attached or longer than kLongestMovable, as furniture is: their middle by up to
/// kMostVariantShift and themselves by up to kMostVariantTurn. A supported object moves
/// horizontally and turns about the vertical, the rest in all directions. The object nearest to
/// the hand at the goal takes the hand along: the arm's inverse kinematics is solved for the
/// same pose of the palm relative to it. Then each other object is shifted towards the robot at
/// the goal, or away from it, until variant_gap() is left, as far as it may move; and the
/// fingers close until kVariantHandGap is left. No object gets deeper into another one than it
/// is.
///
/// A variant depends on problem, number and seed alone, bitwise.
class VariantGenerator {
 public:
  /// @param problem outlives this.
  explicit VariantGenerator(const planning::PlanningProblem& problem);
  ~VariantGenerator();

  /// Draws placements until start and goal are free, 100 times at most.
  /// @param number ≥ 1.
  [[nodiscard]] SceneVariant make(int number, std::uint64_t seed) const;

  /// The objects relative to which the goal is kept; empty: none is near the hand.
  [[nodiscard]] const std::vector<std::string>& target() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace handway::tools
