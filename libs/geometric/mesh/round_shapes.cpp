#include "handway/geometric/mesh/round_shapes.h"

#include <memory>

namespace handway::geometric {

std::vector<std::pair<Shape, Pose>> capsule_shapes(double radius, double length) {
  std::vector<std::pair<Shape, Pose>> shapes = {{Cylinder{radius, length}, Pose::Identity()}};
  for (const double end : {-0.5 * length, 0.5 * length}) {
    shapes.emplace_back(Sphere{radius}, Pose(Eigen::Translation3d(0.0, 0.0, end)));
  }
  return shapes;
}

Mesh ellipsoid_mesh(const Eigen::Vector3d& radii) {
  return {{},
          Eigen::Vector3d::Ones(),
          std::make_shared<const TriangleMesh>(
              transformed(*tessellate(Sphere{1.0}), Pose::Identity(), radii))};
}

}  // namespace handway::geometric
