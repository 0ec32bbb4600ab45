#include "collision/inside_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace handway::geometric {
namespace {

// Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
bool crosses(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d across = direction.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant == 0.0) {
    return false;
  }
  const Eigen::Vector3d to_origin = origin - a;
  const double u = to_origin.dot(across) / determinant;
  if (u < 0.0 || u > 1.0) {
    return false;
  }
  const Eigen::Vector3d turned = to_origin.cross(ab);
  const double v = direction.dot(turned) / determinant;
  return v >= 0.0 && u + v <= 1.0 && ac.dot(turned) / determinant > 0.0;
}

}  // namespace

bool is_inside(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  // Along no axis, plane or diagonal of anything that was drawn.
  static const std::array<Eigen::Vector3d, 3> kRays{Eigen::Vector3d(0.5477, 0.3121, 0.7763),
                                                    Eigen::Vector3d(-0.7193, 0.6613, 0.2129),
                                                    Eigen::Vector3d(0.1297, -0.8411, -0.5251)};
  const auto odd = [&](const Eigen::Vector3d& ray) {
    return std::ranges::count_if(mesh.triangles,
                                 [&](const auto& t) {
                                   return crosses(p, ray, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                  mesh.vertices[t[2]]);
                                 }) %
               2 ==
           1;
  };
  return std::ranges::count_if(kRays, odd) >= 2;
}

}  // namespace handway::geometric
