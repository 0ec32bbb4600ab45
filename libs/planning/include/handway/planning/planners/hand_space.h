#pragma once

namespace handway::planning {

/// Which hand postures a planner draws from.
enum class HandSpace {
  kPrincipalDirections,  ///< SC^h: free joints and principal motion directions (the paper's
                         ///< method).
  kAllJoints,            ///< C^h: every joint over its range (its comparison, section 6.2).
};

}  // namespace handway::planning
