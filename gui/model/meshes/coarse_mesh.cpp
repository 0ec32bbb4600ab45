#include "model/meshes/coarse_mesh.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

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

}  // namespace handway::gui
