#pragma once

#include "handway/planning/core/objective.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace handway::tools {

/// What a path is judged by, keys as `objective` in docs/command-line.md; null without a path.
[[nodiscard]] nlohmann::ordered_json path_quality_json(
    const std::optional<planning::PathQuality>& quality);

}  // namespace handway::tools
