#pragma once

#include "handway/planning/core/parameter.h"
#include "handway/planning/planners/target_region.h"

#include <vector>

namespace handway::planning {

/// Descriptions of the parameters that several planners have.
[[nodiscard]] Parameter max_samples_parameter(int& value);
[[nodiscard]] Parameter smoothing_checks_parameter(int& value);
[[nodiscard]] Parameter corridor_parameter(int& value);

/// Of all that a region is made of.
void append_region_parameters(std::vector<Parameter>& list, TargetRegion& region);

}  // namespace handway::planning
