#include "collision/fcl_bodies.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <map>

namespace handway::geometric {
namespace {

using Tree = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<const Tree> build(const TriangleMesh& mesh) {
  auto tree = std::make_shared<Tree>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.emplace_back(a, b, c);
  }
  tree->beginModel();
  tree->addSubModel(mesh.vertices, triangles);
  tree->endModel();
  return tree;
}

}  // namespace

struct FclBodies::Impl {
  std::vector<std::shared_ptr<const Tree>> trees;
};

FclBodies::FclBodies(const CollisionWorld& world) : impl_(std::make_unique<Impl>()) {
  std::map<const TriangleMesh*, std::shared_ptr<const Tree>> built;  // fingers share meshes
  for (const CollisionBody& body : world.bodies()) {
    auto& tree = built[body.mesh.get()];
    if (!tree) {
      tree = build(*body.mesh);
    }
    impl_->trees.push_back(tree);
  }
}

FclBodies::~FclBodies() = default;

bool FclBodies::collide(int a, const Pose& X_WA, int b, const Pose& X_WB) const {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(impl_->trees[static_cast<std::size_t>(a)].get(), X_WA,
                      impl_->trees[static_cast<std::size_t>(b)].get(), X_WB, request, result) > 0;
}

double FclBodies::distance(int a, const Pose& X_WA, int b, const Pose& X_WB, double enough) const {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  result.min_distance = enough;  // FCL prunes whatever is not closer than this
  fcl::distance(impl_->trees[static_cast<std::size_t>(a)].get(), X_WA,
                impl_->trees[static_cast<std::size_t>(b)].get(), X_WB, request, result);
  return std::max(0.0, result.min_distance);
}

}  // namespace handway::geometric
