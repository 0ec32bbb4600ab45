#include "handway/geometric/mesh/shape.h"

#include "handway/geometric/mesh/triangle_mesh.h"
#include "mesh/round_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::uint32_t kFewestSegments = 32;
constexpr std::uint32_t kMostSegments = 1024;  // reached by a ball of 10 m and a cylinder of 21 m

// The least number of segments, a multiple of four, so that each spans at most `half_angle` (rad)
// to either side of its middle.
std::uint32_t segments_within(double half_angle) {
  const double segments = std::numbers::pi / half_angle;
  const auto fours = static_cast<std::uint32_t>(std::ceil(std::min(segments, 1e6) / 4.0));
  return std::clamp(4 * fours, kFewestSegments, kMostSegments);
}

// The regular polygon around a circle is outside by radius (1/cos(π/n) - 1) at its corners.
std::uint32_t circle_segments(double radius) {
  return segments_within(std::acos(radius / (radius + kRoundTolerance)));
}

// A polyhedron of twice as many segments around as rings from pole to pole is outside the ball by
// radius tan²(π/n).
std::uint32_t ball_segments(double radius) {
  return segments_within(std::atan(std::sqrt(kRoundTolerance / radius)));
}

TriangleMesh triangles_of(const Box& box) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.emplace_back(corner.cwiseProduct(box.size));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Builds the surface of a round shape from rings of `segments` vertices each around the z axis.
class RingMesh {
 public:
  explicit RingMesh(std::uint32_t segments) : segments_(segments) {}

  // Adds a ring around a circle: the circle touches its edges from within.
  // @returns the index of its first vertex.
  std::uint32_t add_ring(double radius, double z) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const double step = 2.0 * std::numbers::pi / segments_;
    const double outer = radius / std::cos(0.5 * step);
    for (std::uint32_t i = 0; i < segments_; ++i) {
      mesh_.vertices.emplace_back(outer * std::cos(i * step), outer * std::sin(i * step), z);
    }
    return first;
  }

  // Joins ring `below` to ring `above`, facing outward.
  void add_band(std::uint32_t below, std::uint32_t above) {
    for (std::uint32_t i = 0; i < segments_; ++i) {
      const std::uint32_t next = (i + 1) % segments_;
      mesh_.triangles.push_back({below + i, below + next, above + i});
      mesh_.triangles.push_back({below + next, above + next, above + i});
    }
  }

  // Joins a ring to a single vertex on the axis, facing down (-z side) or up.
  void add_cap(std::uint32_t ring, double z, bool facing_down) {
    const auto apex = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.emplace_back(0.0, 0.0, z);
    for (std::uint32_t i = 0; i < segments_; ++i) {
      const std::uint32_t next = (i + 1) % segments_;
      if (facing_down) {
        mesh_.triangles.push_back({ring + next, ring + i, apex});
      } else {
        mesh_.triangles.push_back({ring + i, ring + next, apex});
      }
    }
  }

  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t segments_;
  TriangleMesh mesh_;
};

TriangleMesh triangles_of(const Cylinder& cylinder) {
  return round_mesh(cylinder, circle_segments(cylinder.radius));
}

TriangleMesh triangles_of(const Cone& cone) {
  return round_mesh(cone, circle_segments(cone.radius));
}

TriangleMesh triangles_of(const Sphere& sphere) {
  return round_mesh(sphere, ball_segments(sphere.radius));
}

TriangleMesh triangles_of(const Mesh& mesh) { return *mesh.triangles; }

TriangleMesh triangles_of(const Cloud& cloud) { return *cloud.surface; }

Shape times(Box box, double scale) {
  box.size *= scale;
  return box;
}

Shape times(Sphere sphere, double scale) {
  sphere.radius *= scale;
  return sphere;
}

template <typename Round>
Shape times(Round shape, double scale) {
  shape.radius *= scale;
  shape.length *= scale;
  return shape;
}

Shape times_about_mean(const TriangleMesh& mesh, double scale) {
  auto triangles = std::make_shared<TriangleMesh>(mesh);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : triangles->vertices) {
    centre += vertex / static_cast<double>(triangles->vertices.size());
  }
  for (Eigen::Vector3d& vertex : triangles->vertices) {
    vertex = centre + scale * (vertex - centre);
  }
  return Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)};
}

Shape times(const Mesh& mesh, double scale) { return times_about_mean(*mesh.triangles, scale); }

Shape times(const Cloud& cloud, double scale) { return times_about_mean(*cloud.surface, scale); }

}  // namespace

TriangleMesh round_mesh(const Cylinder& cylinder, std::uint32_t segments) {
  RingMesh mesh(segments);
  const double half = 0.5 * cylinder.length;
  const std::uint32_t bottom = mesh.add_ring(cylinder.radius, -half);
  const std::uint32_t top = mesh.add_ring(cylinder.radius, half);
  mesh.add_band(bottom, top);
  mesh.add_cap(bottom, -half, true);
  mesh.add_cap(top, half, false);
  return mesh.take();
}

TriangleMesh round_mesh(const Cone& cone, std::uint32_t segments) {
  RingMesh mesh(segments);
  const double half = 0.5 * cone.length;
  const std::uint32_t bottom = mesh.add_ring(cone.radius, -half);
  mesh.add_cap(bottom, -half, true);
  mesh.add_cap(bottom, half, false);
  return mesh.take();
}

// Rings halfway between the usual latitudes are tangent to the sphere along their middle.
TriangleMesh round_mesh(const Sphere& sphere, std::uint32_t segments) {
  RingMesh mesh(segments);
  const std::uint32_t rings = segments / 2;
  const double step = std::numbers::pi / rings;
  const double radius = sphere.radius / std::cos(0.5 * step);
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi - i * step;
    const std::uint32_t ring = mesh.add_ring(radius * std::sin(polar), radius * std::cos(polar));
    if (i > 1) {
      mesh.add_band(last, ring);
    } else {
      first = ring;
    }
    last = ring;
  }
  mesh.add_cap(first, -radius, true);
  mesh.add_cap(last, radius, false);
  return mesh.take();
}

std::string_view shape_name(const Shape& shape) {
  static constexpr std::array<std::string_view, 6> kNames = {"box",  "sphere", "cylinder",
                                                             "cone", "mesh",   "cloud"};
  return kNames[shape.index()];
}

std::shared_ptr<const TriangleMesh> tessellate(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) {
    return mesh->triangles;
  }
  if (const Cloud* cloud = std::get_if<Cloud>(&shape)) {
    return cloud->surface;
  }
  return std::make_shared<TriangleMesh>(
      std::visit([](const auto& solid) { return triangles_of(solid); }, shape));
}

Shape scaled(const Shape& shape, double scale) {
  return std::visit([&](const auto& one) { return times(one, scale); }, shape);
}

bool is_closed(const Shape& shape) {
  const Mesh* mesh = std::get_if<Mesh>(&shape);
  return !mesh || is_closed(distinct_triangles(welded(*mesh->triangles)));
}

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
          std::make_shared<const TriangleMesh>(transformed(
              round_mesh(Sphere{1.0}, ball_segments(radii.maxCoeff())), Pose::Identity(), radii))};
}

}  // namespace handway::geometric
