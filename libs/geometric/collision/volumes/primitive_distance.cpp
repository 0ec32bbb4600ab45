#include "collision/volumes/primitive_distance.h"

#include "handway/geometric/mesh/shape.h"
#include "mesh/round_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kSamePlace = 1e-9;       // share of the size: same place as a primitive's
constexpr float kRadiusRounding = 2e-6F;  // share of a radius: bound of rounding

// Returns the box corner at each vertex, one bit per axis; nothing if a vertex is not a corner.
std::optional<std::vector<unsigned>> corner_numbers(const TriangleMesh& mesh, const Aabb& box) {
  std::vector<unsigned> numbers;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    unsigned number = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const bool is_upper = p[axis] == box.upper[axis];
      if (box.upper[axis] <= box.lower[axis] || (!is_upper && p[axis] != box.lower[axis])) {
        return std::nullopt;
      }
      number |= is_upper ? 1U << axis : 0U;
    }
    numbers.push_back(number);
  }
  return numbers;
}

// Returns whether the triangles cover each face of the box by two that share a diagonal of it.
bool is_box(const TriangleMesh& mesh, const Aabb& box) {
  constexpr std::size_t kTriangles = 12;
  constexpr unsigned kAll = 7;  // the bits of all axes
  if (mesh.triangles.size() != kTriangles) {
    return false;
  }
  const std::optional<std::vector<unsigned>> numbers = corner_numbers(mesh, box);
  if (!numbers) {
    return false;
  }
  std::array<std::vector<unsigned>, 6> missing;  // per face: the corner that a triangle leaves out
  for (const auto& [i, j, k] : mesh.triangles) {
    const unsigned a = (*numbers)[i];
    const unsigned b = (*numbers)[j];
    const unsigned c = (*numbers)[k];
    const unsigned across = kAll & ~((a ^ b) | (a ^ c));
    if (across != 1 && across != 2 && across != 4) {
      return false;  // in no face, or without an area
    }
    missing[2 * std::countr_zero(across) + ((a & across) != 0 ? 1 : 0)].push_back(a ^ b ^ c);
  }
  return std::ranges::all_of(missing, [](const std::vector<unsigned>& corners) {
    return corners.size() == 2 && (std::popcount(corners[0] ^ corners[1]) == 2);
  });
}

// Returns whether `mesh` is `unit`, a primitive of size 1, stretched by `by`.
bool is_stretched(const TriangleMesh& mesh, const TriangleMesh& unit, const Eigen::Vector3d& by) {
  const double tolerance = kSamePlace * by.maxCoeff();
  for (std::size_t i = 0; i < unit.vertices.size(); ++i) {
    if (!((mesh.vertices[i] - unit.vertices[i].cwiseProduct(by)).lpNorm<Eigen::Infinity>() <=
          tolerance)) {
      return false;
    }
  }
  return true;
}

// Returns the inner radius of the regular polygon that a round primitive is from above, as a share
// of its outer radius.
double share_within(const TriangleMesh& unit_cylinder) {
  const Eigen::Vector3d& a = unit_cylinder.vertices[0];
  const Eigen::Vector3d& b = unit_cylinder.vertices[1];
  return (0.5 * (a + b)).head<2>().norm() / a.head<2>().norm();
}

double share_within_ball(const TriangleMesh& ball) {
  double nearest = 1e30;
  double farthest = 0.0;
  for (const auto& [i, j, k] : ball.triangles) {
    const Eigen::Vector3d& a = ball.vertices[i];
    const Eigen::Vector3d normal = (ball.vertices[j] - a).cross(ball.vertices[k] - a);
    nearest = std::min(nearest, std::abs(normal.dot(a)) / normal.norm());
    farthest = std::max(farthest, a.norm());
  }
  return nearest / farthest;
}

Eigen::Vector2f nearest_on_segment(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                                   const Eigen::Vector2f& p) {
  const Eigen::Vector2f along = b - a;
  const float share = (p - a).dot(along) / std::max(along.squaredNorm(), 1e-30F);
  return a + std::clamp(share, 0.0F, 1.0F) * along;
}

}  // namespace

std::optional<PrimitiveDistance> PrimitiveDistance::of(const TriangleMesh& mesh) {
  const Aabb box = bounding_box(mesh);
  std::optional<PrimitiveDistance> primitive;
  if (is_box(mesh, box)) {
    primitive = PrimitiveDistance(Kind::kBox, box);
  } else {
    primitive = round_primitive(mesh, box);
  }
  if (primitive) {
    primitive->centre_ = box.centre().cast<float>();
    primitive->half_ = (0.5 * box.size()).cast<float>();
  }
  return primitive;
}

std::optional<PrimitiveDistance> PrimitiveDistance::round_primitive(const TriangleMesh& mesh,
                                                                    const Aabb& box) {
  for (const auto& [kind, segments] : possible_segments(mesh)) {
    const TriangleMesh unit = kind == Kind::kSphere     ? round_mesh(Sphere{1.0}, segments)
                              : kind == Kind::kCylinder ? round_mesh(Cylinder{1.0, 1.0}, segments)
                                                        : round_mesh(Cone{1.0, 1.0}, segments);
    const Eigen::Vector3d by = box.size().cwiseQuotient(bounding_box(unit).size()).cwiseAbs();
    const bool is_round =
        std::abs(by.x() - by.y()) <= kSamePlace * by.x() &&
        (kind != Kind::kSphere || std::abs(by.x() - by.z()) <= kSamePlace * by.x());
    if (!is_round || mesh.triangles != unit.triangles || !is_stretched(mesh, unit, by)) {
      continue;
    }
    PrimitiveDistance primitive(kind, box);
    double outer = 0.0;
    for (const Eigen::Vector3d& p : mesh.vertices) {
      outer = std::max(outer, kind == Kind::kSphere ? p.norm() : p.head<2>().norm());
    }
    const double within = kind == Kind::kSphere ? share_within_ball(unit) : share_within(unit);
    primitive.outer_ = static_cast<float>(outer) * (1.0F + kRadiusRounding);
    primitive.inner_ = static_cast<float>(outer * within) * (1.0F - kRadiusRounding);
    return primitive;
  }
  return std::nullopt;
}

std::vector<std::pair<PrimitiveDistance::Kind, std::uint32_t>> PrimitiveDistance::possible_segments(
    const TriangleMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<std::pair<Kind, std::uint32_t>> possible;
  const auto add = [&](Kind kind, std::uint32_t segments, std::uint32_t vertices) {
    if (segments >= 4 && segments % 4 == 0 && vertices == count) {
      possible.emplace_back(kind, segments);
    }
  };
  if (count < 6) {
    return possible;
  }
  const std::uint32_t in_rings = count - 2;
  const auto of_ball =
      static_cast<std::uint32_t>(std::lround(1.0 + std::sqrt(1.0 + 2.0 * in_rings)));
  add(Kind::kSphere, of_ball, of_ball * (of_ball / 2 - 1) + 2);
  add(Kind::kCylinder, in_rings / 2, count - count % 2);
  add(Kind::kCone, in_rings, count);
  return possible;
}

float PrimitiveDistance::box_distance(const Eigen::Vector3f& p) const {
  const Eigen::Vector3f beyond = (p - centre_).cwiseAbs() - half_;
  const float inside = beyond.maxCoeff();
  return inside <= 0.0F ? inside : beyond.cwiseMax(0.0F).norm();
}

PrimitiveDistance::Section PrimitiveDistance::offset_from_outer(const Section& p) const {
  const float half = half_.z();
  if (kind_ == Kind::kCylinder) {
    return {std::max(p.x() - outer_, 0.0F),
            std::copysign(std::max(std::abs(p.y()) - half, 0.0F), p.y())};
  }
  const Section rim(outer_, -half);
  const Section normal(2.0F * half, outer_);
  if (p.y() >= -half && normal.dot(p - rim) <= 0.0F) {
    return Section::Zero();
  }
  const Section from_slope = p - nearest_on_segment(rim, {0.0F, half}, p);
  const Section from_base = p - nearest_on_segment({0.0F, -half}, rim, p);
  return from_slope.squaredNorm() < from_base.squaredNorm() ? from_slope : from_base;
}

float PrimitiveDistance::depth_in_inner(const Section& p) const {
  const float half = half_.z();
  if (kind_ == Kind::kCylinder) {
    return std::min(inner_ - p.x(), half - std::abs(p.y()));
  }
  const Section normal = Section(2.0F * half, inner_).normalized();
  return std::min(normal.dot(Section(inner_, -half) - p), p.y() + half);
}

float PrimitiveDistance::round_bound(const Eigen::Vector3f& p) const {
  if (kind_ == Kind::kSphere) {
    const float from_centre = p.norm();
    return std::max(from_centre - outer_, inner_ - from_centre);
  }
  const Section section(p.head<2>().norm(), p.z());
  return std::max(offset_from_outer(section).norm(), depth_in_inner(section));
}

PrimitiveDistance::Tangent PrimitiveDistance::tangent(const Eigen::Vector3f& p) const {
  if (kind_ == Kind::kBox) {
    const Eigen::Vector3f from_centre = p - centre_;
    const Eigen::Vector3f offset =
        (from_centre.cwiseAbs() - half_).cwiseMax(0.0F).cwiseProduct(from_centre.cwiseSign());
    const float distance = offset.norm();
    return {distance, offset / std::max(distance, 1e-30F)};
  }
  if (kind_ == Kind::kSphere) {
    const float from_centre = p.norm();
    return {from_centre - outer_, p / std::max(from_centre, 1e-30F)};
  }
  const float from_axis = p.head<2>().norm();
  const Section offset = offset_from_outer({from_axis, p.z()});
  const float distance = offset.norm();
  const Section slope = offset / std::max(distance, 1e-30F);
  const Eigen::Vector2f outward = p.head<2>() / std::max(from_axis, 1e-30F);
  return {distance, {slope.x() * outward.x(), slope.x() * outward.y(), slope.y()}};
}

std::optional<bool> PrimitiveDistance::contains(const Eigen::Vector3d& p) const {
  if ((p.array() < box_.lower.array()).any() || (p.array() > box_.upper.array()).any()) {
    return false;
  }
  if (kind_ == Kind::kBox) {
    return true;
  }
  const Eigen::Vector3f point = p.cast<float>();
  const float clear = kRadiusRounding * half_.lpNorm<1>();
  const Section section(point.head<2>().norm(), point.z());
  const bool is_ball = kind_ == Kind::kSphere;
  if ((is_ball ? inner_ - point.norm() : depth_in_inner(section)) > clear) {
    return true;
  }
  return (is_ball ? point.norm() - outer_ : offset_from_outer(section).norm()) > clear
             ? std::optional(false)
             : std::nullopt;
}

}  // namespace handway::geometric
