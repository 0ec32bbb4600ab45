#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// Distance of a hand from the recorded postures of human hands; in normalised joints, 0 is as
/// human as can be.
struct HandLikeness {
  double to_subspace = 0.0;           ///< See sampling::PostureSubspace.
  std::optional<double> to_recorded;  ///< Distance to the nearest recorded posture, if any.
};

/// Measures how human-like a robot's hand is in any configuration.
class HANDWAY_PLANNING_EXPORT HumanLikeness {
 public:
  /// @param model outlives this. @param hand variables of the basis' joints, in its order.
  /// @param postures may be null. @throws std::invalid_argument for another number of variables.
  HumanLikeness(const geometric::RobotModel& model, geometric::JointIndices hand,
                const sampling::PmdBasis& basis,
                std::shared_ptr<const sampling::RecordedPostures> postures);

  [[nodiscard]] HandLikeness at(const Configuration& q) const;

  /// `q` with the hand in the recorded posture nearest to its own; nothing without postures.
  [[nodiscard]] std::optional<Configuration> nearest_recorded(const Configuration& q) const;

 private:
  const geometric::RobotModel& model_;
  geometric::JointIndices hand_;
  sampling::PostureSubspace subspace_;
  std::shared_ptr<const sampling::RecordedPostures> postures_;
};

/// Mean and largest of a distance along a path.
struct DistanceAlong {
  double mean = 0.0;
  double largest = 0.0;
};

/// Likeness of the hand along a path to a human hand.
struct PathLikeness {
  DistanceAlong to_subspace;
  std::optional<DistanceAlong> to_recorded;  ///< Empty without recorded postures.
};

/// Means are over the path's length in normalised joints, from steps of at most a hundredth.
/// @throws std::invalid_argument for a path without waypoints.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PathLikeness path_likeness(const geometric::RobotModel& model,
                                                                 const HumanLikeness& likeness,
                                                                 const Path& path);

}  // namespace handway::planning
