#include "view3d/crease_normals.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>

namespace handway::gui {
namespace {

using Index = std::uint32_t;
using Place = std::array<std::int64_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::size_t hash = 0;
    for (const std::int64_t coordinate : place) {
      hash = hash * 1000003U + std::hash<std::int64_t>{}(coordinate);
    }
    return hash;
  }
};

// For every vertex the number of the place where it lies, on a grid of a
// ten-thousandth of a millimetre.
std::vector<Index> number_places(const std::vector<Eigen::Vector3d>& vertices) {
  constexpr double kGrid = 1e7;
  std::unordered_map<Place, Index, PlaceHash> numbers;
  std::vector<Index> place_of(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& v = vertices[i];
    const Place place{std::llround(v.x() * kGrid), std::llround(v.y() * kGrid),
                      std::llround(v.z() * kGrid)};
    place_of[i] = numbers.emplace(place, static_cast<Index>(numbers.size())).first->second;
  }
  return place_of;
}

struct Face {
  std::array<Index, 3> corners;  // vertices of the mesh
  std::array<Index, 3> places;
  std::array<double, 3> angles;  // rad, at each corner
  Eigen::Vector3d normal;        // unit length
};

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Face> list_faces(const geometric::TriangleMesh& mesh) {
  const std::vector<Index> place_of = number_places(mesh.vertices);
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d &pa = mesh.vertices[a], &pb = mesh.vertices[b], &pc = mesh.vertices[c];
    const Eigen::Vector3d cross = (pb - pa).cross(pc - pa);
    if (!(cross.norm() > 0.0)) {
      continue;
    }
    faces.push_back({{a, b, c},
                     {place_of[a], place_of[b], place_of[c]},
                     {angle_between(pb - pa, pc - pa), angle_between(pc - pb, pa - pb),
                      angle_between(pa - pc, pb - pc)},
                     cross.normalized()});
  }
  return faces;
}

}  // namespace

ShadedMesh with_crease_normals(const geometric::TriangleMesh& mesh, double crease_angle) {
  const std::vector<Face> faces = list_faces(mesh);
  struct Corner {
    std::size_t face;
    std::size_t corner;
  };
  std::unordered_map<Index, std::vector<Corner>> around;  // place -> corners there
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      around[faces[f].places[k]].push_back({f, k});
    }
  }

  const double smooth = std::cos(crease_angle);
  ShadedMesh shaded;
  shaded.triangles.reserve(faces.size());
  std::map<std::pair<Index, std::array<int, 3>>, Index> numbers;
  for (const Face& face : faces) {
    std::array<Index, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (const Corner& other : around[face.places[k]]) {
        const Face& neighbour = faces[other.face];
        if (neighbour.normal.dot(face.normal) >= smooth) {
          normal += neighbour.angles[other.corner] * neighbour.normal;
        }
      }
      normal.normalize();
      const Eigen::Vector3i rounded = (normal * 1e4).array().round().cast<int>();
      const auto [entry, is_new] =
          numbers.try_emplace({face.places[k], {rounded.x(), rounded.y(), rounded.z()}},
                              static_cast<Index>(shaded.vertices.size()));
      if (is_new) {
        shaded.vertices.push_back(mesh.vertices[face.corners[k]].cast<float>());
        shaded.normals.push_back(normal.cast<float>());
      }
      triangle[k] = entry->second;
    }
    shaded.triangles.push_back(triangle);
  }
  return shaded;
}

}  // namespace handway::gui
