#include "handway/geometric/mesh/shape.h"

#include "handway/geometric/mesh/triangle_mesh.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace handway::geometric {
namespace {

// A regular n-gon around a circle leaves it by a factor 1/cos(π/n): 0.48 % for 32.
constexpr std::uint32_t kSegments = 32;
constexpr std::uint32_t kRings = 32;  // of a sphere, pole to pole

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

Eigen::Vector3d on_circle(std::uint32_t segment, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * segment / kSegments;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// Joins ring `below` to ring `above`, both of kSegments vertices, facing outward.
void add_band(TriangleMesh& mesh, std::uint32_t below, std::uint32_t above) {
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const std::uint32_t next = (i + 1) % kSegments;
    mesh.triangles.push_back({below + i, below + next, above + i});
    mesh.triangles.push_back({below + next, above + next, above + i});
  }
}

// Joins a ring to a single vertex, facing down (-z side) or up.
void add_cap(TriangleMesh& mesh, std::uint32_t ring, std::uint32_t apex, bool facing_down) {
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const std::uint32_t next = (i + 1) % kSegments;
    if (facing_down) {
      mesh.triangles.push_back({ring + next, ring + i, apex});
    } else {
      mesh.triangles.push_back({ring + i, ring + next, apex});
    }
  }
}

std::uint32_t add_ring(TriangleMesh& mesh, double radius, double z) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    mesh.vertices.push_back(on_circle(i, radius, z));
  }
  return first;
}

std::uint32_t add_vertex(TriangleMesh& mesh, const Eigen::Vector3d& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

const double kAround = 1.0 / std::cos(std::numbers::pi / kSegments);

TriangleMesh triangles_of(const Cylinder& cylinder) {
  TriangleMesh mesh;
  const double half = 0.5 * cylinder.length;
  const std::uint32_t bottom = add_ring(mesh, cylinder.radius * kAround, -half);
  const std::uint32_t top = add_ring(mesh, cylinder.radius * kAround, half);
  add_band(mesh, bottom, top);
  add_cap(mesh, bottom, add_vertex(mesh, {0, 0, -half}), true);
  add_cap(mesh, top, add_vertex(mesh, {0, 0, half}), false);
  return mesh;
}

TriangleMesh triangles_of(const Cone& cone) {
  TriangleMesh mesh;
  const double half = 0.5 * cone.length;
  const std::uint32_t bottom = add_ring(mesh, cone.radius * kAround, -half);
  add_cap(mesh, bottom, add_vertex(mesh, {0, 0, -half}), true);
  add_cap(mesh, bottom, add_vertex(mesh, {0, 0, half}), false);
  return mesh;
}

// Rings halfway between the usual latitudes are tangent to the sphere along their
// middle; growing by both roundings keeps the sphere inside and the error below 0.7 %.
TriangleMesh triangles_of(const Sphere& sphere) {
  TriangleMesh mesh;
  const double step = std::numbers::pi / kRings;
  const double radius = sphere.radius / std::cos(0.5 * step);
  std::array<std::uint32_t, kRings> rings{};
  for (std::uint32_t i = 1; i < kRings; ++i) {
    const double polar = std::numbers::pi - i * step;
    rings[i] = add_ring(mesh, radius * std::sin(polar) * kAround, radius * std::cos(polar));
    if (i > 1) {
      add_band(mesh, rings[i - 1], rings[i]);
    }
  }
  add_cap(mesh, rings[1], add_vertex(mesh, {0, 0, -radius}), true);
  add_cap(mesh, rings[kRings - 1], add_vertex(mesh, {0, 0, radius}), false);
  return mesh;
}

TriangleMesh triangles_of(const Mesh& mesh) { return *mesh.triangles; }

Shape larger(Box box, const Padding& by) {
  box.size = (by.scale * box.size).array() + 2.0 * by.distance;
  return box;
}

Shape larger(Sphere sphere, const Padding& by) {
  sphere.radius = by.scale * sphere.radius + by.distance;
  return sphere;
}

template <typename Round>
Shape larger(Round shape, const Padding& by) {
  shape.radius = by.scale * shape.radius + by.distance;
  shape.length = by.scale * shape.length + 2.0 * by.distance;
  return shape;
}

Shape larger(const Mesh& mesh, const Padding& by) {
  auto triangles = std::make_shared<TriangleMesh>(*mesh.triangles);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : triangles->vertices) {
    centre += vertex / static_cast<double>(triangles->vertices.size());
  }
  for (Eigen::Vector3d& vertex : triangles->vertices) {
    const Eigen::Vector3d arm = vertex - centre;
    vertex = centre + by.scale * arm + by.distance * arm.stableNormalized();
  }
  return Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)};
}

}  // namespace

std::string_view shape_name(const Shape& shape) {
  static constexpr std::array<std::string_view, 5> kNames = {"box", "sphere", "cylinder", "cone",
                                                             "mesh"};
  return kNames[shape.index()];
}

std::shared_ptr<const TriangleMesh> tessellate(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) {
    return mesh->triangles;
  }
  return std::make_shared<TriangleMesh>(
      std::visit([](const auto& solid) { return triangles_of(solid); }, shape));
}

Shape padded(const Shape& shape, const Padding& padding) {
  return std::visit([&](const auto& one) { return larger(one, padding); }, shape);
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
          std::make_shared<const TriangleMesh>(
              transformed(*tessellate(Sphere{1.0}), Pose::Identity(), radii))};
}

}  // namespace handway::geometric
