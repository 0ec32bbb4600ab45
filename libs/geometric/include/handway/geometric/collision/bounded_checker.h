#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace handway::geometric {

/// Indices of a triangle of one body and of one of another.
struct TrianglePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// The everyday checker: the answers of FclChecker, most of them from bounding
/// spheres or remembered distances alone, the rest from the triangles that are
/// closer than what was asked for. Only what seems to touch goes to FCL.
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
  [[nodiscard]] Closeness do_pair_closeness(int pair, double tolerance) override;
  [[nodiscard]] double do_pair_bound(int pair, double enough) override;

  /// A lower bound of the pair's distance up to `enough`, from a few spheres.
  [[nodiscard]] double bound(int pair, double enough) const;

  /// A lower bound from the pair's table of distances, if it has one; else 0.
  [[nodiscard]] double remembered(int pair);

  /// The pair's distance up to `enough` with the bodies at `X_WBody`.
  [[nodiscard]] double exact_distance(int pair, std::span<const Pose> X_WBody, double enough);

  [[nodiscard]] Closeness exact_closeness(int pair, double tolerance);

  std::shared_ptr<const Volumes> volumes_;
  std::vector<TrianglePair> witnesses_;  ///< Per pair: what was closest when last asked.
};

}  // namespace handway::geometric
