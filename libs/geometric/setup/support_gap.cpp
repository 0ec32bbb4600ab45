#include "handway/geometric/setup/placing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of a vertex, an edge or a triangle; in order of the least x.
template <std::size_t N>
struct Part {
  std::array<Vector3d, N> corners;
  Vector2d lower;
  Vector2d upper;

  explicit Part(const std::array<Vector3d, N>& points)
      : corners(points), lower(points[0].template head<2>()), upper(points[0].template head<2>()) {
    for (const Vector3d& p : points) {
      lower = lower.cwiseMin(p.head<2>());
      upper = upper.cwiseMax(p.head<2>());
    }
  }
  [[nodiscard]] bool overlaps(const Vector2d& from, const Vector2d& to) const {
    return (lower.array() <= to.array()).all() && (upper.array() >= from.array()).all();
  }
};

struct Parts {
  std::vector<Part<1>> vertices;
  std::vector<Part<2>> edges;
  std::vector<Part<3>> triangles;
};

template <std::size_t N>
void keep(std::vector<Part<N>>& parts, const Part<N>& part, const Aabb& region) {
  if (part.overlaps(region.lower.head<2>(), region.upper.head<2>())) {
    parts.push_back(part);
  }
}

template <std::size_t N>
void sort(std::vector<Part<N>>& parts) {
  std::ranges::sort(parts, {}, [](const Part<N>& part) { return part.lower.x(); });
}

// Returns the parts of the mesh in the region, seen from above.
Parts parts_in(const TriangleMesh& mesh, const Aabb& region) {
  Parts parts;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Vector3d& v : mesh.vertices) {
    keep(parts.vertices, Part<1>({v}), region);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    keep(parts.triangles, Part<3>({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}), region);
    for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
      edges.emplace_back(edge.first, edge.second);
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    keep(parts.edges, Part<2>({mesh.vertices[a], mesh.vertices[b]}), region);
  }
  sort(parts.vertices);
  sort(parts.edges);
  sort(parts.triangles);
  return parts;
}

// Height of the triangle's plane above a point in it.
std::optional<double> height_at(const Part<3>& triangle, const Vector2d& p) {
  const auto& [a, b, c] = triangle.corners;
  const Vector2d ab = (b - a).head<2>(), ac = (c - a).head<2>(), ap = p - a.head<2>();
  const double area = cross(ab, ac);
  if (area == 0.0) {
    return std::nullopt;
  }
  const double v = cross(ap, ac) / area, w = cross(ab, ap) / area;
  if (v < 0.0 || w < 0.0 || v + w > 1.0) {
    return std::nullopt;
  }
  return a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
}

class LeastGap {
 public:
  explicit LeastGap(double middle) : middle_(middle) {}

  void add(double upper, double lower) {
    if (lower <= middle_) {
      gap_ = std::min(gap_, upper - lower);
    }
  }
  void add_crossing(const Part<2>& upper, const Part<2>& lower) {
    const Vector2d u = (upper.corners[1] - upper.corners[0]).head<2>();
    const Vector2d l = (lower.corners[1] - lower.corners[0]).head<2>();
    const double turn = cross(u, l);
    if (turn == 0.0) {
      return;
    }
    const Vector2d between = (lower.corners[0] - upper.corners[0]).head<2>();
    const double s = cross(between, l) / turn, t = cross(between, u) / turn;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
      add(upper.corners[0].z() + s * (upper.corners[1].z() - upper.corners[0].z()),
          lower.corners[0].z() + t * (lower.corners[1].z() - lower.corners[0].z()));
    }
  }
  [[nodiscard]] std::optional<double> value() const {
    return gap_ < std::numeric_limits<double>::infinity() ? std::optional(gap_) : std::nullopt;
  }

 private:
  double middle_;
  double gap_ = std::numeric_limits<double>::infinity();
};

// Calls `visit` for all pairs that overlap from above; both sorted.
template <std::size_t M, std::size_t N, typename Visit>
void for_overlapping(const std::vector<Part<M>>& first, const std::vector<Part<N>>& second,
                     const Visit& visit) {
  for (const Part<M>& a : first) {
    for (const Part<N>& b : second) {
      if (b.lower.x() > a.upper.x()) {
        break;
      }
      if (b.overlaps(a.lower, a.upper)) {
        visit(a, b);
      }
    }
  }
}

}  // namespace

std::optional<double> vertical_gap(const TriangleMesh& upper, const TriangleMesh& lower) {
  if (upper.empty() || lower.empty()) {
    return std::nullopt;
  }
  const Aabb above = bounding_box(upper), below = bounding_box(lower);
  const Aabb region{above.lower.cwiseMax(below.lower), above.upper.cwiseMin(below.upper)};
  if (region.lower.x() > region.upper.x() || region.lower.y() > region.upper.y()) {
    return std::nullopt;
  }
  const Parts a = parts_in(upper, region), b = parts_in(lower, region);
  LeastGap gap(above.centre().z());
  for_overlapping(a.vertices, b.triangles, [&](const Part<1>& vertex, const Part<3>& triangle) {
    const Vector3d& v = vertex.corners[0];
    if (const auto z = height_at(triangle, v.head<2>())) {
      gap.add(v.z(), *z);
    }
  });
  for_overlapping(b.vertices, a.triangles, [&](const Part<1>& vertex, const Part<3>& triangle) {
    const Vector3d& v = vertex.corners[0];
    if (const auto z = height_at(triangle, v.head<2>())) {
      gap.add(*z, v.z());
    }
  });
  for_overlapping(a.edges, b.edges,
                  [&](const Part<2>& u, const Part<2>& l) { gap.add_crossing(u, l); });
  return gap.value();
}

std::optional<double> gap_to_support(const Scene& scene, const SceneObject& object) {
  const TriangleMesh upper = transformed(*tessellate(object.shape), object.X_PO);
  std::optional<double> least;
  for (const SceneObject& other : scene.objects) {
    if (other.name == object.name || other.attachment) {
      continue;
    }
    const auto gap = vertical_gap(upper, transformed(*tessellate(other.shape), other.X_PO));
    if (gap && (!least || *gap < *least)) {
      least = gap;
    }
  }
  return least;
}

double height_above_floor(const SceneObject& object) {
  return bounding_box(transformed(*tessellate(object.shape), object.X_PO)).lower.z();
}

}  // namespace handway::geometric
