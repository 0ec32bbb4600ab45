#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/export.h"

#include <memory>

namespace handway::geometric {

/// Checkers that give the same answers.
enum class CheckerKind {
  kFast,           ///< ExactCollisionChecker.
  kFcl,            ///< FclChecker.
  kFclBroadphase,  ///< FclBroadphaseChecker.
};

/// @param kind the one that programs use unless asked for another is exact and fast.
/// @throws PreparationStopped where `preparation` asks for it.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world, CheckerKind kind = CheckerKind::kFast,
    const Preparation& preparation = {});

}  // namespace handway::geometric
