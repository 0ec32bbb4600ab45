#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"

#include <memory>

namespace handway::geometric {

/// The reference: FCL's OBBRSS trees on the raw triangles, one pair after the other, without a
/// broad phase; then a test whether one body contains the other.
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

/// FCL in its usual setup: a dynamic AABB tree over the moving bodies, one over the fixed ones,
/// OBBRSS trees on the raw triangles behind them. The baseline to which the fast checker is
/// compared.
///
/// If several pairs touch, first_collision() returns the one that the trees meet first.
class HANDWAY_GEOMETRIC_EXPORT FclBroadphaseChecker final : public CollisionChecker {
 public:
  explicit FclBroadphaseChecker(std::shared_ptr<const CollisionWorld> world);
  ~FclBroadphaseChecker() override;

  [[nodiscard]] std::unique_ptr<CollisionChecker> clone() const override;

 private:
  struct Models;  // immutable, shared by clones; keeps FCL out of the header
  struct Managers;

  FclBroadphaseChecker(const FclBroadphaseChecker& other);
  void do_place() override;
  [[nodiscard]] bool do_pair_collides(int pair) override;
  [[nodiscard]] double do_pair_distance(int pair, double enough) override;
  [[nodiscard]] std::optional<int> do_first_collision(int hint) override;

  std::shared_ptr<const Models> models_;
  std::unique_ptr<Managers> managers_;
};

}  // namespace handway::geometric
