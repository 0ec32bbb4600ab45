#pragma once

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"

#include <algorithm>
#include <memory>

namespace handway::test {

/// An edge checker as planners use it, and dense sampling with FCL to judge it.
class EdgeJudge {
 public:
  EdgeJudge(const geometric::Scene& scene, double resolution)
      : world_(std::make_shared<const geometric::CollisionWorld>(scene)),
        motion_(std::make_shared<const geometric::MotionBound>(*world_)),
        exact_(world_),
        bounded_(world_),
        edges_(bounded_, motion_, resolution) {}

  [[nodiscard]] const geometric::CollisionWorld& world() const { return *world_; }
  [[nodiscard]] const geometric::MotionBound& motion() const { return *motion_; }
  [[nodiscard]] geometric::FclChecker& exact() { return exact_; }
  [[nodiscard]] geometric::ContinuousCollisionChecker& edges() { return edges_; }

  /// Returns whether FCL finds a collision when no point moves more than `step` (m) between
  /// samples.
  [[nodiscard]] bool collides(const geometric::Configuration& from,
                              const geometric::Configuration& to, double step) {
    const geometric::Configuration delta = to - from;
    const int samples = sample_count(delta, step);
    for (int s = 0; s <= samples; ++s) {
      if (exact_.first_collision(from + (static_cast<double>(s) / samples) * delta)) {
        return true;
      }
    }
    return false;
  }

  /// The smallest clearance (m, up to 5 cm) at such samples.
  [[nodiscard]] double clearance(const geometric::Configuration& from,
                                 const geometric::Configuration& to, double step) {
    const geometric::Configuration delta = to - from;
    const int samples = sample_count(delta, step);
    double least = 0.05;
    for (int s = 0; s <= samples; ++s) {
      const geometric::Configuration q = from + (static_cast<double>(s) / samples) * delta;
      least = std::min(least, find_clearance(exact_, q, least).distance);
    }
    return least;
  }

 private:
  [[nodiscard]] int sample_count(const geometric::Configuration& delta, double step) const {
    return std::max(1, static_cast<int>(motion_->any_point(delta.cwiseAbs()) / step));
  }

  std::shared_ptr<const geometric::CollisionWorld> world_;
  std::shared_ptr<const geometric::MotionBound> motion_;
  geometric::FclChecker exact_;
  geometric::ExactCollisionChecker bounded_;
  geometric::ContinuousCollisionChecker edges_;
};

}  // namespace handway::test
