#pragma once

#include "handway/geometric/collision/bounded_checker.h"
#include "handway/geometric/collision/fcl_checker.h"

#include <gtest/gtest.h>

#include <memory>

namespace handway::test {

/// Asks FclChecker and BoundedChecker the same questions.
class CheckerAgreement {
 public:
  explicit CheckerAgreement(const geometric::Scene& scene)
      : world_(std::make_shared<const geometric::CollisionWorld>(scene)),
        exact_(world_),
        bounded_(world_) {}

  [[nodiscard]] const geometric::CollisionWorld& world() const { return *world_; }
  [[nodiscard]] geometric::FclChecker& exact() { return exact_; }
  [[nodiscard]] int collisions() const { return collisions_; }
  [[nodiscard]] int frees() const { return frees_; }

  /// Every pair: do they touch?
  void expect_same_collisions(const geometric::Configuration& q) {
    exact_.place(q);
    bounded_.place(q);
    int touching = 0;
    for (int pair = 0; pair < static_cast<int>(world_->pairs().size()); ++pair) {
      const bool collides = exact_.pair_collides(pair);
      touching += collides ? 1 : 0;
      ASSERT_EQ(bounded_.pair_collides(pair), collides) << name(pair) << " at " << q.transpose();
    }
    (touching > 0 ? collisions_ : frees_) += 1;
    ASSERT_EQ(bounded_.first_collision(q).has_value(), touching > 0) << q.transpose();
  }

  /// Every pair: how far apart, up to `enough`?
  void expect_same_distances(const geometric::Configuration& q, double enough) {
    exact_.place(q);
    bounded_.place(q);
    for (int pair = 0; pair < static_cast<int>(world_->pairs().size()); ++pair) {
      const double distance = exact_.pair_distance(pair, enough);
      const double bounded = bounded_.pair_distance(pair, enough);
      ASSERT_LE(bounded_.pair_bound(pair, enough), distance + 1e-9) << name(pair);
      if (distance < enough) {
        ASSERT_NEAR(bounded, distance, 1e-9) << name(pair) << " at " << q.transpose();
      } else {
        ASSERT_GE(bounded, enough - 1e-9) << name(pair) << " at " << q.transpose();
      }
    }
  }

 private:
  [[nodiscard]] std::string name(int pair) const {
    const geometric::BodyPair& bodies = world_->pairs()[static_cast<std::size_t>(pair)];
    return world_->body(bodies.a).name + " with " + world_->body(bodies.b).name;
  }

  std::shared_ptr<const geometric::CollisionWorld> world_;
  geometric::FclChecker exact_;
  geometric::BoundedChecker bounded_;
  int collisions_ = 0;
  int frees_ = 0;
};

}  // namespace handway::test
