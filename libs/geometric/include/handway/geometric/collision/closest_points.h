#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string_view>

namespace handway::geometric {

/// Where two bodies are closest to each other; world, m.
struct ClosestPoints {
  Eigen::Vector3d p_WA;  ///< On the first one's surface.
  Eigen::Vector3d p_WB;  ///< On the second one's.
};

/// Finds the closest points of bodies of a world, for people to see. For one thread.
class HANDWAY_GEOMETRIC_EXPORT ClosestPointFinder {
 public:
  explicit ClosestPointFinder(std::shared_ptr<const CollisionWorld> world);
  ~ClosestPointFinder();

  /// @param a, b names of bodies. @param q shape [variable_count].
  /// @returns nothing if there is no such body or they touch.
  [[nodiscard]] std::optional<ClosestPoints> between(std::string_view a, std::string_view b,
                                                     const Configuration& q);

 private:
  struct Trees;

  std::shared_ptr<const CollisionWorld> world_;
  std::unique_ptr<Trees> trees_;
};

}  // namespace handway::geometric
