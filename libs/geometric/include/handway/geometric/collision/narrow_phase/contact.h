#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace handway::geometric {

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
