#include "model/meshes/drawn_mesh.h"

#include "handway/geometric/math/units.h"
#include "model/meshes/coarse_mesh.h"
#include "model/meshes/solid_surface.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr double kCreaseAngle = geometric::radians(35.0);
constexpr double kCoarseCreaseAngle = geometric::radians(50.0);  // round parts have less facets
constexpr std::array kErrors{0.0005, 0.0015, 0.005, 0.015};      // of the mesh's size
constexpr double kMostPixels = 2.0;
constexpr std::size_t kFewTriangles = 200;
constexpr std::size_t kManyTriangles = 400'000;  // would take seconds
constexpr double kEnoughLess = 0.7;              // of the triangles of the mesh before

// The part of the screen that a box covers is not less than its smallest side there: the scale is
// at most the root of their quotient.
double smallest_side(const Eigen::Vector3d& size) { return size.prod() / size.maxCoeff(); }

}  // namespace

DrawnMesh prepare_to_draw(const geometric::TriangleMesh& mesh) {
  DrawnMesh drawn;
  drawn.fine = with_crease_normals(mesh, kCreaseAngle);
  const geometric::TriangleMesh whole = welded_to_draw(mesh);
  drawn.is_solid = is_solid(whole);
  std::size_t triangles = whole.triangles.size();
  if (triangles < kFewTriangles || triangles > kManyTriangles) {
    return drawn;
  }
  const Eigen::Vector3d size = bounding_box(whole).size();
  for (const double share : kErrors) {
    const double error = share * size.norm();
    const auto [coarse, origins] = coarsened(whole, error);
    const double scale = kMostPixels / error;  // px/m
    if (static_cast<double>(coarse.triangles.size()) <
        kEnoughLess * static_cast<double>(triangles)) {
      triangles = coarse.triangles.size();
      drawn.coarser.push_back({with_normals_of(whole, coarse, origins, kCoarseCreaseAngle),
                               static_cast<float>(scale * scale * smallest_side(size))});
    }
  }
  return drawn;
}

}  // namespace handway::gui
