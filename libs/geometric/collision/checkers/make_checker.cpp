#include "handway/geometric/collision/checkers/make_checker.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"

#include <utility>

namespace handway::geometric {

std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world, CheckerKind kind, const Preparation& preparation) {
  switch (kind) {
    case CheckerKind::kFcl:
      return std::make_unique<FclChecker>(std::move(world));
    case CheckerKind::kFclBroadphase:
      return std::make_unique<FclBroadphaseChecker>(std::move(world));
    case CheckerKind::kFast:
      break;
  }
  return std::make_unique<ExactCollisionChecker>(std::move(world), preparation);
}

}  // namespace handway::geometric
