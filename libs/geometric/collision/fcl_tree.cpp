#include "collision/fcl_tree.h"

#include <vector>

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

}  // namespace handway::geometric
