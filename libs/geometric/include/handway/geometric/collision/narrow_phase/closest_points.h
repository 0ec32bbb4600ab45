#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <optional>
#include <string_view>

namespace handway::geometric {

/// Closest points of two bodies; world, m.
struct ClosestPoints {
  Eigen::Vector3d p_WA;  ///< On the first one's surface.
  Eigen::Vector3d p_WB;  ///< On the second one's.
};

/// Finds the closest points of bodies of a world. For one thread.
class HANDWAY_GEOMETRIC_EXPORT ClosestPointFinder {
 public:
  explicit ClosestPointFinder(std::shared_ptr<const CollisionWorld> world);
  ~ClosestPointFinder();

  /// @param a, b names of bodies. @param q shape [variable_count].
  /// @returns nothing for an unknown body, or if they touch.
  [[nodiscard]] std::optional<ClosestPoints> between(std::string_view a, std::string_view b,
                                                     const Configuration& q);

  /// Closest points of two bodies at given poses.
  /// @param a, b indices of the world's bodies. @param X_WA, X_WB their poses.
  /// @param enough m; a smaller value is cheaper.
  /// @returns nothing if they touch or are `enough` or more apart.
  [[nodiscard]] std::optional<ClosestPoints> between(
      int a, int b, const Pose& X_WA, const Pose& X_WB,
      double enough = std::numeric_limits<double>::infinity());

 private:
  struct Surfaces;

  std::shared_ptr<const CollisionWorld> world_;
  std::unique_ptr<Surfaces> surfaces_;
};

}  // namespace handway::geometric
