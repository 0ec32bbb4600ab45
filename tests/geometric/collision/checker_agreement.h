#pragma once

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace handway::test {

/// Compares the answers of FclChecker and ExactCollisionChecker to the same queries.
class CheckerAgreement {
 public:
  explicit CheckerAgreement(const geometric::Scene& scene)
      : CheckerAgreement(std::make_shared<const geometric::CollisionWorld>(scene)) {}
  explicit CheckerAgreement(std::shared_ptr<const geometric::CollisionWorld> world)
      : world_(std::move(world)), exact_(world_), bounded_(world_) {}

  [[nodiscard]] const geometric::CollisionWorld& world() const { return *world_; }
  [[nodiscard]] geometric::FclChecker& exact() { return exact_; }
  [[nodiscard]] geometric::ExactCollisionChecker& bounded() { return bounded_; }
  [[nodiscard]] int collisions() const { return collisions_; }
  [[nodiscard]] int frees() const { return frees_; }
  /// Pairs asked for their distance.
  [[nodiscard]] std::uint64_t pairs_measured() const { return pairs_measured_; }

  /// Compares for every pair whether it collides.
  void expect_same_collisions(const geometric::Configuration& q) {
    exact_.place(q);
    bounded_.place(q);
    int touching = 0;
    for (int pair = 0; pair < pair_count(); ++pair) {
      const bool collides = exact_.pair_collides(pair);
      touching += collides ? 1 : 0;
      ASSERT_EQ(bounded_.pair_collides(pair), collides) << name(pair) << " at " << q.transpose();
    }
    (touching > 0 ? collisions_ : frees_) += 1;
    const std::optional<int> found = bounded_.first_collision(q);
    ASSERT_EQ(found.has_value(), touching > 0) << q.transpose();
    ASSERT_TRUE(!found || exact_.pair_collides(*found)) << name(*found);
  }

  /// Compares for every pair the distance, and whether it is closer than a few tolerances, up to
  /// `enough`.
  void expect_same_distances(const geometric::Configuration& q, double enough) {
    exact_.place(q);
    bounded_.place(q);
    for (int pair = 0; pair < pair_count(); ++pair) {
      const double distance = exact_.pair_distance(pair, enough);
      const double bounded = bounded_.pair_distance(pair, enough);
      ++pairs_measured_;
      ASSERT_LE(bounded_.pair_bound(pair, enough), distance + kRounding) << name(pair);
      if (distance < enough) {
        ASSERT_NEAR(bounded, distance, kRounding) << name(pair) << " at " << q.transpose();
      } else {
        ASSERT_GE(bounded, enough - kRounding) << name(pair) << " at " << q.transpose();
      }
      ASSERT_NO_FATAL_FAILURE(expect_range_around(pair, distance, enough));
      for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 5e-2}) {
        if (tolerance <= enough && std::abs(distance - tolerance) > kRounding) {
          ASSERT_EQ(bounded_.pair_proximity(pair, tolerance), proximity(pair, distance, tolerance))
              << name(pair) << " within " << tolerance << " m at " << q.transpose();
          ASSERT_EQ(bounded_.pair_is_nearer_than(pair, tolerance), distance < tolerance)
              << name(pair) << " nearer than " << tolerance << " m at " << q.transpose();
        }
      }
    }
  }

 private:
  static constexpr double kRounding = 1e-9;  // m

  void expect_range_around(int pair, double distance, double enough) {
    constexpr double kShare = 0.3;
    const geometric::DistanceRange range = bounded_.pair_distance_range(pair, enough, kShare);
    ASSERT_LE(range.lower, distance + kRounding) << name(pair);
    ASSERT_GE(range.upper, distance - kRounding) << name(pair);
    ASSERT_GE(range.lower, (1.0 - kShare) * std::min(distance, enough) - kRounding) << name(pair);
    if (distance < enough - kRounding) {
      ASSERT_LE((1.0 - kShare) * range.upper, range.lower + kRounding) << name(pair);
    }
  }

  [[nodiscard]] int pair_count() const { return static_cast<int>(world_->pairs().size()); }

  [[nodiscard]] geometric::Proximity proximity(int pair, double distance, double tolerance) {
    return distance >= tolerance ? geometric::Proximity::kClear
           : distance <= kRounding && exact_.pair_collides(pair)
               ? geometric::Proximity::kCollision
               : geometric::Proximity::kWithinTolerance;
  }

  [[nodiscard]] std::string name(int pair) const {
    const geometric::BodyPair& bodies = world_->pairs()[static_cast<std::size_t>(pair)];
    return world_->body(bodies.a).name + " with " + world_->body(bodies.b).name;
  }

  std::shared_ptr<const geometric::CollisionWorld> world_;
  geometric::FclChecker exact_;
  geometric::ExactCollisionChecker bounded_;
  int collisions_ = 0;
  int frees_ = 0;
  std::uint64_t pairs_measured_ = 0;
};

}  // namespace handway::test
