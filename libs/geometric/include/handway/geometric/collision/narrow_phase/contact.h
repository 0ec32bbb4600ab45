#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Closest points of two bodies; world, m.
struct ClosestPoints {
  Eigen::Vector3d p_WA;  ///< On the first one's surface.
  Eigen::Vector3d p_WB;  ///< On the second one's.
};

/// Finds the closest points of bodies of a world, for display. For one thread.
class HANDWAY_GEOMETRIC_EXPORT ClosestPointFinder {
 public:
  explicit ClosestPointFinder(std::shared_ptr<const CollisionWorld> world);
  ~ClosestPointFinder();

  /// @param a, b names of bodies. @param q shape [variable_count].
  /// @returns nothing for an unknown body, or if they touch.
  [[nodiscard]] std::optional<ClosestPoints> between(std::string_view a, std::string_view b,
                                                     const Configuration& q);

  /// Closest points of two bodies that stand where they are put.
  /// @param a, b indices of the world's bodies. @param X_WA, X_WB their poses.
  /// @param enough m; the less, the cheaper.
  /// @returns nothing if they touch or are `enough` or more apart.
  [[nodiscard]] std::optional<ClosestPoints> between(
      int a, int b, const Pose& X_WA, const Pose& X_WB,
      double enough = std::numeric_limits<double>::max());

 private:
  struct Trees;

  std::shared_ptr<const CollisionWorld> world_;
  std::unique_ptr<Trees> trees_;
};

/// Place and depth of the intersection of two bodies.
struct Contact {
  /// Depths are not distinguished beyond this, m.
  static constexpr double kMostDepth = 0.2;

  std::string a;
  std::string b;
  /// Middle of the surfaces' intersection; if one body contains the other, a point of the inner
  /// surface.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  /// Direction in which `a` separates: unit vector, world.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  /// Distance by which `a` has to be shifted along `direction` to be clear of `b`, m, to 0.1 mm.
  /// The shortest of some thirty directions: an upper bound of the penetration depth; kMostDepth if
  /// none of them gets clear sooner.
  double depth = kMostDepth;
};

/// The contacts of those of `pairs` (indices into world.pairs()) that touch in `q`, in order. A few
/// milliseconds each: for explanations, not for planning. @param q shape [variable_count].
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<Contact> find_contacts(
    const CollisionWorld& world, const Configuration& q, std::span<const int> pairs);

/// All contacts in `q`, deepest first.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<Contact> find_contacts(CollisionChecker& checker,
                                                                          const Configuration& q);

}  // namespace handway::geometric
