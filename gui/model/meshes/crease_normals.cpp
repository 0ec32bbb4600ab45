#include "model/meshes/crease_normals.h"

#include "model/meshes/solid_surface.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace handway::gui {
namespace {

using Index = std::uint32_t;

struct Face {
  std::array<Index, 3> corners;  // vertices of the mesh
  std::array<Index, 3> places;   // where the normals are looked up
  std::array<double, 3> angles;  // rad, at each corner
  Eigen::Vector3d normal;        // unit length
};

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Face> list_faces(const geometric::TriangleMesh& mesh,
                             const std::vector<Index>& place_of) {
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

std::vector<Index> each_its_own(const geometric::TriangleMesh& mesh) {
  std::vector<Index> places(mesh.vertices.size());
  std::iota(places.begin(), places.end(), Index{0});
  return places;
}

// The triangles that meet at each place.
class Surroundings {
 public:
  explicit Surroundings(const std::vector<Face>& faces) : faces_(faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        around_[faces[f].places[k]].push_back({f, k});
      }
    }
  }

  // The normal at a place of a face with the given one: of the faces there that lie within the
  // crease angle of it, or of the nearest one, as a coarse mesh has faces unlike all around.
  [[nodiscard]] Eigen::Vector3d normal_at(Index place, const Eigen::Vector3d& normal,
                                          double crease_angle) const {
    const auto found = around_.find(place);
    if (found == around_.end()) {
      return normal;
    }
    const double smooth = std::cos(crease_angle);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Face* nearest = &faces_[found->second.front().face];
    for (const Corner& corner : found->second) {
      const Face& face = faces_[corner.face];
      if (face.normal.dot(normal) > nearest->normal.dot(normal)) {
        nearest = &face;
      }
      if (face.normal.dot(normal) >= smooth) {
        sum += face.angles.at(corner.corner) * face.normal;
      }
    }
    return sum.norm() > 0.0 ? sum.normalized() : nearest->normal;
  }

 private:
  struct Corner {
    std::size_t face;
    std::size_t corner;
  };
  const std::vector<Face>& faces_;
  std::unordered_map<Index, std::vector<Corner>> around_;
};

ShadedMesh shade(const geometric::TriangleMesh& mesh, const std::vector<Face>& faces,
                 const Surroundings& surroundings, double crease_angle) {
  ShadedMesh shaded;
  shaded.triangles.reserve(faces.size());
  std::map<std::pair<Index, std::array<int, 3>>, Index> numbers;
  for (const Face& face : faces) {
    std::array<Index, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d normal =
          surroundings.normal_at(face.places[k], face.normal, crease_angle);
      const Eigen::Vector3i rounded = (normal * 1e4).array().round().cast<int>();
      const auto [entry, is_new] =
          numbers.try_emplace({face.corners[k], {rounded.x(), rounded.y(), rounded.z()}},
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

}  // namespace

ShadedMesh with_crease_normals(const geometric::TriangleMesh& mesh, double crease_angle) {
  const geometric::TriangleMesh one = welded_to_draw(mesh);
  const std::vector<Face> faces = list_faces(one, each_its_own(one));
  return shade(one, faces, Surroundings(faces), crease_angle);
}

ShadedMesh with_normals_of(const geometric::TriangleMesh& fine, const geometric::TriangleMesh& mesh,
                           const std::vector<Index>& origins, double crease_angle) {
  const std::vector<Face> around = list_faces(fine, each_its_own(fine));
  return shade(mesh, list_faces(mesh, origins), Surroundings(around), crease_angle);
}

}  // namespace handway::gui
