#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"

#include <memory>

namespace handway::geometric {

/// The checker that programs use unless asked for another: exact and fast.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world);

}  // namespace handway::geometric
