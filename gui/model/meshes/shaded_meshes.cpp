#include "model/meshes/shaded_meshes.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace handway::gui {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool is_oriented_and_closed(const geometric::TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> passed;  // by edge: times up less times down
  const auto pass = [&](std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    passed[(std::uint64_t{low} << 32U) | high] += from < to ? 1 : -1;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    pass(a, b);
    pass(b, c);
    pass(c, a);
  }
  return std::ranges::all_of(passed, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

geometric::TriangleMesh welded_to_draw(const geometric::TriangleMesh& mesh) {
  constexpr double kGrid = 1e-7;  // m
  geometric::TriangleMesh whole = geometric::welded(mesh, kGrid);
  std::erase_if(whole.triangles, [](const Triangle& corners) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
  });
  return whole;
}

bool is_solid(const geometric::TriangleMesh& mesh) {
  if (mesh.empty() || !is_oriented_and_closed(mesh)) {
    return false;
  }
  const std::vector<std::uint32_t> piece_of = geometric::piece_numbers(mesh);
  std::map<std::uint32_t, double> volumes;  // six times, m³
  for (const auto& [a, b, c] : mesh.triangles) {
    volumes[piece_of[a]] += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  return std::ranges::all_of(volumes, [](const auto& piece) { return piece.second > 0.0; });
}

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
