#pragma once

#include "collision/distance_table.h"
#include "collision/surface.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/collision/motion_bound.h"
#include "handway/geometric/io/disk_cache.h"

#include <memory>
#include <vector>

namespace handway::geometric {

/// Poses of the robot's links and of what it carries in its base, shape [bodies]; bodies that
/// stand still are left at the identity. What is derived from them does not depend on where
/// the robot stands.
[[nodiscard]] std::vector<Pose> poses_at_base(const CollisionWorld& world, const Configuration& q);

/// The distance tables of a robot's pairs. What they learn is kept in the user's
/// cache when the last checker goes, for the same robot in later runs.
class RememberedDistances {
 public:
  /// @param surfaces shape [bodies].
  /// @param keeps whether to keep what is learned even if the cache knows nothing of the robot yet.
  RememberedDistances(const CollisionWorld& world,
                      const std::vector<std::shared_ptr<const Surface>>& surfaces, bool keeps);
  ~RememberedDistances();
  RememberedDistances(const RememberedDistances&) = delete;
  RememberedDistances& operator=(const RememberedDistances&) = delete;

  /// Of a pair of the world; null where it has none.
  [[nodiscard]] const DistanceTable* table(int pair) const {
    return tables_[static_cast<std::size_t>(pair)].get();
  }

 private:
  void recall();

  CacheKey key_;
  bool keeps_;
  std::vector<std::unique_ptr<DistanceTable>> tables_;
};

}  // namespace handway::geometric
