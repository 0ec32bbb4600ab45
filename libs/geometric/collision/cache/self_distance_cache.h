#pragma once

#include "collision/cache/surface.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/robot/robot_model.h"

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace handway::geometric {

/// Distances of a pair of bodies that only one or two joints move against each other (neighbouring
/// finger links, wrist and palm), cached on a grid over those joints. Cells are filled on first
/// access, by any thread, with the other joints at rest: a cell's content is bitwise the same
/// whichever thread fills it.
class PairDistanceCache {
 public:
  /// The exact distance (m) of the pair in a configuration.
  using Distance = std::function<double(const Configuration&)>;

  /// A table for `pair` (of two links of the robot), or nothing unless one or two variables move
  /// it.
  [[nodiscard]] static std::unique_ptr<PairDistanceCache> make(const RobotModel& model, int link_a,
                                                               int link_b, int pair,
                                                               const MotionBound& motion);

  /// A lower bound (m) of the distance in `q`: that of the cell's centre minus the largest motion
  /// from there; 0 or less if unknown.
  [[nodiscard]] double bound(const Configuration& q, const Distance& exact) const;

  /// Returns the known distances, shape [cells]; negative where unknown.
  [[nodiscard]] std::vector<float> cells() const;
  void set_cells(std::span<const float> cells);
  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  /// Returns whether any distance was added since set_cells().
  [[nodiscard]] bool has_learned() const { return learned_.load(std::memory_order_relaxed); }

 private:
  struct Axis {
    int variable;
    double lower;
    double cell;   ///< rad or m
    double turn;   ///< Period, rad; 0: not periodic.
    double reach;  ///< m per rad, or m per m
  };

  PairDistanceCache(std::vector<Axis> axes, std::size_t cells_per_axis, Configuration rest);

  std::vector<Axis> axes_;
  Configuration rest_;
  std::size_t cells_per_axis_;
  mutable std::atomic<bool> learned_ = false;
  mutable std::vector<std::atomic<float>> cells_;  ///< Negative: unknown so far.
};

/// Poses of the robot's links and attached objects in its base, shape [bodies]; fixed
/// bodies are left at the identity. Values derived from them do not depend on the robot's
/// place.
[[nodiscard]] std::vector<Pose> poses_at_base(const CollisionWorld& world, const Configuration& q);

/// The distance tables of a robot's pairs. New distances are stored in the user's cache when the
/// last checker is destroyed, for later runs with the same robot.
class SelfDistanceCache {
 public:
  /// @param surfaces shape [bodies].
  /// @param keeps whether to store distances even if the cache has none of the robot yet.
  SelfDistanceCache(const CollisionWorld& world,
                    const std::vector<std::shared_ptr<const Surface>>& surfaces, bool keeps);
  ~SelfDistanceCache();
  SelfDistanceCache(const SelfDistanceCache&) = delete;
  SelfDistanceCache& operator=(const SelfDistanceCache&) = delete;

  /// Table of a pair of the world; null if it has none.
  [[nodiscard]] const PairDistanceCache* table(int pair) const {
    return tables_[static_cast<std::size_t>(pair)].get();
  }

 private:
  void recall();

  CacheKey key_;
  bool keeps_;
  std::vector<std::unique_ptr<PairDistanceCache>> tables_;
};

}  // namespace handway::geometric
