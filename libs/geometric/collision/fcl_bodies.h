#pragma once

#include "handway/geometric/collision/collision_world.h"

#include <memory>
#include <vector>

namespace handway::geometric {

/// FCL's trees of all bodies of a world, shared by the checkers that end in FCL.
class FclBodies {
 public:
  explicit FclBodies(const CollisionWorld& world);
  ~FclBodies();
  FclBodies(const FclBodies&) = delete;
  FclBodies& operator=(const FclBodies&) = delete;

  [[nodiscard]] bool collide(int a, const Pose& X_WA, int b, const Pose& X_WB) const;

  /// Distance (m) where below `enough`, else something from `enough` up; 0 if they touch.
  [[nodiscard]] double distance(int a, const Pose& X_WA, int b, const Pose& X_WB,
                                double enough) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace handway::geometric
