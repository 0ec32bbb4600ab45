#include "handway/geometric/collision/cache/bounding_volumes.h"

#include "collision/cache/surface.h"
#include "handway/geometric/mesh/convex_hull.h"

#include <algorithm>

namespace handway::geometric {
namespace {

constexpr double kThinnest = 1e-5;  // m

void list_spheres(const SphereTree& cover, std::uint32_t node_index, double largest,
                  std::vector<CoveringSphere>& spheres) {
  const SphereTree::Node& node = cover.node(node_index);
  for (std::uint32_t i = 0; i < node.count; ++i) {
    const bool is_leaf = (node.child[i] & SphereTree::kLeaf) != 0;
    if (node.radius[i] > largest && !is_leaf) {
      list_spheres(cover, node.child[i], largest, spheres);
    } else {
      spheres.push_back({{node.x[i], node.y[i], node.z[i]}, node.radius[i]});
    }
  }
}

std::vector<CoveringSphere> spheres_of(const SphereTree& cover, double largest) {
  std::vector<CoveringSphere> spheres;
  if (cover.root().radius <= largest) {
    spheres.push_back({cover.root().centre.cast<double>(), cover.root().radius});
  } else {
    list_spheres(cover, 0, largest, spheres);
  }
  return spheres;
}

TriangleMesh hull_of(const ConvexCover& cover) {
  const std::vector<Eigen::Vector3d> points = cover.points();
  TriangleMesh hull = convex_hull(points);
  if (!hull.empty()) {
    return hull;
  }
  std::vector<Eigen::Vector3d> grown;
  const double margin = std::max(kThinnest, static_cast<double>(cover.margin()));
  for (const Eigen::Vector3d& p : points) {
    for (const double x : {-margin, margin}) {
      for (const double y : {-margin, margin}) {
        for (const double z : {-margin, margin}) {
          grown.emplace_back(p + Eigen::Vector3d(x, y, z));
        }
      }
    }
  }
  return convex_hull(grown);
}

}  // namespace

std::vector<BoundingVolumes> bounding_volumes(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes, double largest) {
  std::vector<BoundingVolumes> volumes;
  volumes.reserve(meshes.size());
  for (const std::shared_ptr<const Surface>& surface : make_surfaces(meshes)) {
    volumes.push_back({spheres_of(surface->cover, largest), hull_of(*surface->hull),
                       static_cast<double>(surface->hull->margin())});
  }
  return volumes;
}

}  // namespace handway::geometric
