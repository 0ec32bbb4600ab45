#pragma once

#include "handway/planning/core/parameter.h"
#include "handway/planning/export.h"
#include "handway/planning/spaces/target_sampler.h"

#include <vector>

namespace handway::planning {

/// Descriptions of the parameters that several planners have.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Parameter max_samples_parameter(int& value);
[[nodiscard]] HANDWAY_PLANNING_EXPORT Parameter smoothing_checks_parameter(int& value);
[[nodiscard]] HANDWAY_PLANNING_EXPORT Parameter corridor_parameter(int& value);

/// Of all that a region is made of but its corridor and PMDs.
HANDWAY_PLANNING_EXPORT void append_region_parameters(std::vector<Parameter>& list,
                                                      TargetRegion& region);

}  // namespace handway::planning
