#include "collision/volumes/convex_cover.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/vector_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace handway::geometric {
namespace {

constexpr std::size_t kVectorWidth = 16;  // floats in a vector
constexpr int kLongestSearch = 64;        // steps towards one vertex
constexpr int kPlanes = 4;                // tried between two hulls

using Simplex = std::array<Eigen::Vector3d, 3>;

const Eigen::Vector3d& farthest(std::span<const Eigen::Vector3d> points,
                                const Eigen::Vector3d& direction) {
  return *std::ranges::max_element(points, {},
                                   [&](const Eigen::Vector3d& p) { return direction.dot(p); });
}

bool contains(const Simplex& base, const Eigen::Vector3d& top, const Eigen::Vector3d& p) {
  Eigen::Matrix3d edges;
  edges << base[0] - top, base[1] - top, base[2] - top;
  const Eigen::Vector3d shares = edges.inverse() * (p - top);
  return shares.allFinite() && shares.minCoeff() >= 0.0 && shares.sum() <= 1.0;
}

/// The vector from the hull of `points` to `p`: from its nearest point or, if the search ends
/// early, from a point near that. Zero if p is within `margin` (m) of the hull.
///
/// Source: Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance
/// between complex objects in three-dimensional space", 1988.
Eigen::Vector3d escape(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& p,
                       double margin) {
  Simplex nearest{points[0], points[points.size() / 2], points[points.size() - 1]};
  Eigen::Vector3d offset = p - nearest_on_triangle(nearest, p);
  for (int step = 0; step < kLongestSearch && offset.norm() > margin; ++step) {
    const Eigen::Vector3d& next = farthest(points, offset);
    const Simplex base = nearest;
    if (contains(base, next, p)) {
      return Eigen::Vector3d::Zero();
    }
    const Eigen::Vector3d last = offset;
    for (std::size_t k = 0; k < 3; ++k) {
      Simplex face = base;
      face[k] = next;
      const Eigen::Vector3d to_face = p - nearest_on_triangle(face, p);
      if (to_face.squaredNorm() < offset.squaredNorm()) {
        offset = to_face;
        nearest = face;
      }
    }
    if (offset == last) {
      return offset;
    }
  }
  return offset.norm() > margin ? offset : Eigen::Vector3d::Zero();
}

std::vector<Eigen::Vector3d> extremes(std::span<const Eigen::Vector3d> vertices) {
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        points.push_back(farthest(vertices, {x, y, z}));
      }
    }
  }
  return points;
}

}  // namespace

ConvexCover::ConvexCover(const TriangleMesh& mesh, double margin) {
  std::vector<Eigen::Vector3d> points = extremes(mesh.vertices);
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    Eigen::Vector3d offset = escape(points, vertex, margin);
    while (!offset.isZero(0.0)) {
      const Eigen::Vector3d& beyond = farthest(mesh.vertices, offset);
      const bool known = std::ranges::find(points, beyond) != points.end();
      points.push_back(known ? vertex : beyond);
      offset = known ? Eigen::Vector3d::Zero() : escape(points, vertex, margin);
    }
  }
  constexpr float kRounding = 1e-6F;  // of the coordinates: that of single precision
  float largest = 0.0F;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    largest = std::max(largest, static_cast<float>(p.lpNorm<Eigen::Infinity>()));
    sum += p;
  }
  middle_ = (sum / static_cast<double>(points.size())).cast<float>();
  margin_ = static_cast<float>(margin) + kRounding * largest;
  count_ = points.size();
  points.resize((count_ + kVectorWidth - 1) / kVectorWidth * kVectorWidth, points.back());
  for (const Eigen::Vector3d& p : points) {
    x_.push_back(static_cast<float>(p.x()));
    y_.push_back(static_cast<float>(p.y()));
    z_.push_back(static_cast<float>(p.z()));
  }
}

std::vector<Eigen::Vector3d> ConvexCover::points() const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    points.emplace_back(x_[i], y_[i], z_[i]);
  }
  return points;
}

HANDWAY_VECTOR_UNITS Eigen::Vector3f ConvexCover::support(const Eigen::Vector3f& direction) const {
  alignas(64) std::array<float, kVectorWidth> most;
  alignas(64) std::array<std::int32_t, kVectorWidth> where{};
  most.fill(-std::numeric_limits<float>::infinity());
  const float dx = direction.x();
  const float dy = direction.y();
  const float dz = direction.z();
  for (std::size_t first = 0; first < x_.size(); first += kVectorWidth) {
    for (std::size_t k = 0; k < kVectorWidth; ++k) {
      const float along = dx * x_[first + k] + dy * y_[first + k] + dz * z_[first + k];
      where[k] = along > most[k] ? static_cast<std::int32_t>(first + k) : where[k];
      most[k] = along > most[k] ? along : most[k];
    }
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < kVectorWidth; ++k) {
    best = most[k] > most[best] ? k : best;
  }
  const auto i = static_cast<std::size_t>(where[best]);
  return {x_[i], y_[i], z_[i]};
}

float hull_gap(const ConvexCover& a, const ConvexCover& b, const FloatPose& X_BA, float enough) {
  using RowMajor = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> R(X_BA.R.data());
  const Eigen::Map<const Eigen::Vector3f> p(X_BA.p.data());
  const float lost = a.margin() + b.margin() + X_BA.rounding;
  float most = 0.0F;
  Eigen::Vector3f apart = R * a.middle() + p - b.middle();  // of two points of the hulls
  for (int plane = 0; plane < kPlanes; ++plane) {
    const float distance = apart.norm();
    if (distance <= lost + most) {
      break;
    }
    const Eigen::Vector3f nearest_of_a = R * a.support(-(R.transpose() * apart)) + p;
    const Eigen::Vector3f between = nearest_of_a - b.support(apart);
    most = std::max(most, apart.dot(between) / distance - lost);
    if (most >= enough) {
      break;
    }
    const Eigen::Vector3f step = between - apart;
    const float share = -apart.dot(step) / std::max(step.squaredNorm(), 1e-20F);
    apart += std::clamp(share, 0.0F, 1.0F) * step;
  }
  return most;
}

}  // namespace handway::geometric
