#include "handway/geometric/collision/closest_points.h"

#include "collision/fcl_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Trees of the bodies that were asked for, and where the bodies are.
struct ClosestPointFinder::Trees {
  FclTrees of_meshes;
  std::vector<Pose> X_BL;
  std::vector<Pose> X_WBody;

  const FclTree* get(const CollisionBody& body) { return of_meshes.of(*body.mesh).get(); }
};

ClosestPointFinder::ClosestPointFinder(std::shared_ptr<const CollisionWorld> world)
    : world_(std::move(world)), trees_(std::make_unique<Trees>()) {}

ClosestPointFinder::~ClosestPointFinder() = default;

std::optional<ClosestPoints> ClosestPointFinder::between(std::string_view a, std::string_view b,
                                                         const Configuration& q) {
  const auto& bodies = world_->bodies();
  const auto find = [&](std::string_view name) {
    return std::ranges::find(bodies, name, &CollisionBody::name);
  };
  const auto body_a = find(a);
  const auto body_b = find(b);
  if (body_a == bodies.end() || body_b == bodies.end()) {
    return std::nullopt;
  }
  trees_->X_BL.resize(static_cast<std::size_t>(world_->model().link_count()));
  trees_->X_WBody.resize(bodies.size());
  world_->place(q, trees_->X_BL, trees_->X_WBody);
  const Pose& X_WA = trees_->X_WBody[static_cast<std::size_t>(body_a - bodies.begin())];
  const Pose& X_WB = trees_->X_WBody[static_cast<std::size_t>(body_b - bodies.begin())];
  const fcl::DistanceRequestd request(true);
  fcl::DistanceResultd result;
  fcl::distance(trees_->get(*body_a), X_WA, trees_->get(*body_b), X_WB, request, result);
  if (result.min_distance <= 0.0) {
    return std::nullopt;
  }
  return ClosestPoints{result.nearest_points[0], result.nearest_points[1]};
}

}  // namespace handway::geometric
