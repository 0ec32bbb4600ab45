#include "collision/narrow_phase/fcl_bodies.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace handway::geometric {
std::shared_ptr<FclTree> make_fcl_tree(const TriangleMesh& mesh) {
  auto tree = std::make_shared<FclTree>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.emplace_back(a, b, c);
  }
  tree->beginModel();
  tree->addSubModel(mesh.vertices, triangles);
  tree->endModel();
  tree->computeLocalAABB();
  return tree;
}

namespace {

// The tree of a mesh, built on first access, by any thread.
class LazyTree {
 public:
  explicit LazyTree(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  const FclTree* get() {
    std::call_once(built_, [this] { tree_ = make_fcl_tree(*mesh_); });
    return tree_.get();
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::once_flag built_;
  std::shared_ptr<const FclTree> tree_;
};

}  // namespace

struct FclBodies::Impl {
  [[nodiscard]] const FclTree* tree(int body) const {
    return trees[static_cast<std::size_t>(body)]->get();
  }

  std::vector<std::shared_ptr<LazyTree>> trees;
};

FclBodies::FclBodies(const CollisionWorld& world) : impl_(std::make_unique<Impl>()) {
  std::map<const TriangleMesh*, std::shared_ptr<LazyTree>> made;  // fingers share meshes
  for (const CollisionBody& body : world.bodies()) {
    auto& tree = made[body.mesh.get()];
    if (!tree) {
      tree = std::make_shared<LazyTree>(body.mesh);
    }
    impl_->trees.push_back(tree);
  }
}

FclBodies::~FclBodies() = default;

bool FclBodies::collide(int a, const Pose& X_WA, int b, const Pose& X_WB) const {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(impl_->tree(a), X_WA, impl_->tree(b), X_WB, request, result) > 0;
}

double FclBodies::distance(int a, const Pose& X_WA, int b, const Pose& X_WB, double enough) const {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  result.min_distance = enough;  // FCL prunes whatever is not closer than this
  fcl::distance(impl_->tree(a), X_WA, impl_->tree(b), X_WB, request, result);
  return std::max(0.0, result.min_distance);
}

}  // namespace handway::geometric
