#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"

#include <memory>

namespace handway::geometric {

/// The reference: FCL's OBBRSS trees on the raw triangles, one pair after the
/// other, nothing in front of them; and whether one body is inside of the other.
class HANDWAY_GEOMETRIC_EXPORT FclChecker final : public CollisionChecker {
 public:
  explicit FclChecker(std::shared_ptr<const CollisionWorld> world);
  ~FclChecker() override;

  [[nodiscard]] std::unique_ptr<CollisionChecker> clone() const override;

 private:
  struct Trees;  // keeps FCL out of the header

  FclChecker(const FclChecker& other);
  [[nodiscard]] bool do_pair_collides(int pair) override;
  [[nodiscard]] double do_pair_distance(int pair, double enough) override;

  std::shared_ptr<const Trees> trees_;
};

}  // namespace handway::geometric
