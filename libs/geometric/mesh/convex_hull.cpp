#include "handway/geometric/mesh/convex_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace handway::geometric {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kFlat = 1e-9;  // share of the size: nearer points are on a plane

class Hull {
 public:
  explicit Hull(std::span<const Vector3d> points) : points_(points) {
    if (const auto first = tetrahedron()) {
      for (const Corners& face : *first) {
        add(face);
      }
      for (std::uint32_t i = 0; i < points_.size(); ++i) {
        take_in(i);
      }
    }
  }

  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh mesh;
    std::map<std::uint32_t, std::uint32_t> renamed;
    for (const Face& face : faces_) {
      Corners corners{};
      std::ranges::transform(face.corners, corners.begin(), [&](std::uint32_t corner) {
        const auto [entry, is_new] =
            renamed.emplace(corner, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) {
          mesh.vertices.push_back(points_[corner]);
        }
        return entry->second;
      });
      mesh.triangles.push_back(corners);
    }
    return mesh;
  }

 private:
  struct Face {
    Corners corners;
    Vector3d normal;
    double offset;
  };

  template <typename Distance>
  [[nodiscard]] std::uint32_t farthest(const Distance& distance) const {
    const auto most = std::ranges::max_element(points_, {}, distance);
    return static_cast<std::uint32_t>(most - points_.begin());
  }

  // Four points with a volume, as outward faces.
  [[nodiscard]] std::optional<std::array<Corners, 4>> tetrahedron() {
    if (points_.size() < 4) {
      return std::nullopt;
    }
    const Vector3d& a = points_.front();
    const std::uint32_t b = farthest([&](const Vector3d& p) { return (p - a).norm(); });
    const double size = (points_[b] - a).norm();
    tolerance_ = kFlat * size;
    const Vector3d along = (points_[b] - a).normalized();
    const std::uint32_t c = farthest([&](const Vector3d& p) { return along.cross(p - a).norm(); });
    const Vector3d normal = along.cross(points_[c] - a);
    if (normal.norm() <= 1e3 * tolerance_) {
      return std::nullopt;
    }
    const std::uint32_t d =
        farthest([&](const Vector3d& p) { return std::abs(normal.normalized().dot(p - a)); });
    const double height = normal.normalized().dot(points_[d] - a);
    if (std::abs(height) <= 1e3 * tolerance_) {
      return std::nullopt;
    }
    if (height > 0.0) {  // then the first three look inwards
      return std::array{Corners{0, c, b}, Corners{0, b, d}, Corners{b, c, d}, Corners{c, 0, d}};
    }
    return std::array{Corners{0, b, c}, Corners{b, 0, d}, Corners{c, b, d}, Corners{0, c, d}};
  }

  void add(const Corners& corners) {
    const Vector3d& a = points_[corners[0]];
    const Vector3d normal = (points_[corners[1]] - a).cross(points_[corners[2]] - a).normalized();
    faces_.push_back({corners, normal, normal.dot(a)});
  }

  void take_in(std::uint32_t point) {
    const auto sees = [&](const Face& face) {
      return face.normal.dot(points_[point]) - face.offset > tolerance_;
    };
    std::set<Edge> edges;
    for (const Face& face : faces_) {
      if (sees(face)) {
        for (std::size_t i = 0; i < 3; ++i) {
          edges.emplace(face.corners[i], face.corners[(i + 1) % 3]);
        }
      }
    }
    std::erase_if(faces_, sees);
    for (const auto& [from, to] : edges) {
      if (!edges.contains({to, from})) {
        add({from, to, point});
      }
    }
  }

  std::span<const Vector3d> points_;
  double tolerance_ = 0.0;
  std::vector<Face> faces_;
};

}  // namespace

TriangleMesh convex_hull(std::span<const Vector3d> points) { return Hull(points).mesh(); }

}  // namespace handway::geometric
