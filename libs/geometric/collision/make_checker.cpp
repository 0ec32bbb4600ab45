#include "handway/geometric/collision/make_checker.h"

#include "handway/geometric/collision/bounded_checker.h"

namespace handway::geometric {

std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world) {
  return std::make_unique<BoundedChecker>(std::move(world));
}

}  // namespace handway::geometric
