#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"

#include <memory>

namespace handway::geometric {

/// The everyday checker: the answers of FclChecker, most of them from bounding
/// spheres alone. A pair goes to FCL only where the spheres of one body come
/// closer to the triangles of the other than can tell.
class HANDWAY_GEOMETRIC_EXPORT BoundedChecker final : public CollisionChecker {
 public:
  explicit BoundedChecker(std::shared_ptr<const CollisionWorld> world);
  ~BoundedChecker() override;

  [[nodiscard]] std::unique_ptr<CollisionChecker> clone() const override;

 private:
  struct Volumes;  // immutable, shared by clones

  BoundedChecker(const BoundedChecker& other);
  [[nodiscard]] bool do_pair_collides(int pair) override;
  [[nodiscard]] double do_pair_distance(int pair, double enough) override;
  [[nodiscard]] double do_pair_bound(int pair, double enough) override;

  /// A lower bound of the pair's distance up to `enough`, from at most `effort` spheres.
  [[nodiscard]] double bound(int pair, double enough, int effort) const;

  /// A lower bound from the pair's table of distances, if it has one; else 0.
  [[nodiscard]] double remembered(int pair);

  std::shared_ptr<const Volumes> volumes_;
};

}  // namespace handway::geometric
