#pragma once

#include "handway/planning/planners/corridor_form.h"

namespace handway::planning {

/// Where planners with PMDs draw the targets of their searches from: around the
/// straight motion of the arm and around both ends. Lengths in joints normalised
/// to [0, 1]; with a Cartesian corridor in units of sampling::CartesianScale.
struct TargetRegion {
  int corridor = static_cast<int>(CorridorForm::kJoint);  ///< A CorridorForm.
  double near_ends = 0.7;   ///< Share of samples drawn around start and goal.
  double rho_a = 0.1;       ///< Half-width of the arm corridor at the start.
  double rho_max = 0.4;     ///< … and at most.
  double rho_growth = 1.5;  ///< Factor after every `samples_per_width`.
  int samples_per_width = 300;
};

}  // namespace handway::planning
