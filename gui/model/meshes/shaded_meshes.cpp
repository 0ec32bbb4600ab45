#include "model/meshes/shaded_meshes.h"

#include "handway/geometric/math/units.h"
#include "model/meshes/crease_normals.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <mutex>

namespace handway::gui {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kAsFewAsCan = 0;  // triangles: the error alone ends it

}  // namespace

CoarseMesh coarsened(const geometric::TriangleMesh& mesh, double error) {
  std::vector<Eigen::Vector3f> places;
  places.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices) {
    places.emplace_back(v.cast<float>());
  }
  const float* first = places.front().data();
  constexpr std::size_t kStride = sizeof(Eigen::Vector3f);
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  const float scale = meshopt_simplifyScale(first, places.size(), kStride);
  const std::size_t indices = meshopt_simplify(
      triangles.data()->data(), mesh.triangles.data()->data(), 3 * mesh.triangles.size(), first,
      places.size(), kStride, kAsFewAsCan, static_cast<float>(error) / scale, 0, nullptr);
  triangles.resize(indices / 3);

  CoarseMesh coarse;
  std::vector<std::uint32_t> number(places.size(), kUnused);
  for (auto& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) {
      if (number[vertex] == kUnused) {
        number[vertex] = static_cast<std::uint32_t>(coarse.origins.size());
        coarse.origins.push_back(vertex);
        coarse.mesh.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = number[vertex];
    }
  }
  coarse.mesh.triangles = std::move(triangles);
  return coarse;
}

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

namespace {

class Shop {
 public:
  std::shared_ptr<const DrawnMesh> find(
      const std::shared_ptr<const geometric::TriangleMesh>& mesh) {
    const std::lock_guard lock(mutex_);
    const auto found = made_.find(mesh);
    return found == made_.end() ? nullptr : found->second;
  }

  void keep(const std::shared_ptr<const geometric::TriangleMesh>& mesh,
            std::shared_ptr<const DrawnMesh> shaded) {
    const std::lock_guard lock(mutex_);
    std::erase_if(made_, [](const auto& entry) { return entry.first.expired(); });
    made_.emplace(mesh, std::move(shaded));
  }

 private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const geometric::TriangleMesh>, std::shared_ptr<const DrawnMesh>,
           std::owner_less<>>
      made_;
};

Shop& shop() {
  static Shop shop;
  return shop;
}

}  // namespace

std::shared_ptr<const DrawnMesh> shaded(
    const std::shared_ptr<const geometric::TriangleMesh>& mesh) {
  if (auto known = shop().find(mesh)) {
    return known;
  }
  auto made = std::make_shared<const DrawnMesh>(prepare_to_draw(*mesh));
  shop().keep(mesh, made);
  return made;
}

void shade_meshes(const geometric::Scene& scene) {
  const auto shade = [](const geometric::Shape& shape) {
    if (const auto* mesh = std::get_if<geometric::Mesh>(&shape); mesh && mesh->triangles) {
      static_cast<void>(shaded(mesh->triangles));
    }
  };
  for (const geometric::RobotInstance& robot : scene.robots) {
    for (int link = 0; link < robot.model->link_count(); ++link) {
      for (const geometric::LinkGeometry& geometry : shown_geometry(robot.model->link(link))) {
        shade(geometry.shape);
      }
    }
  }
  for (const geometric::SceneObject& object : scene.objects) {
    shade(object.shape);
  }
}

}  // namespace handway::gui
