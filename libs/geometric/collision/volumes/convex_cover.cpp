#include "collision/volumes/convex_cover.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/simplex.h"
#include "math/vector_units.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace handway::geometric {
namespace {

constexpr std::size_t kVectorWidth = 16;  // floats in a vector
constexpr std::size_t kMostPoints =
    512;  // of a hull; its margin is doubled until so many are enough …
constexpr double kLeastMargin = 1e-6;  // … from this on, m
constexpr int kLongestSearch = 64;     // steps towards one vertex

const Eigen::Vector3d& farthest(std::span<const Eigen::Vector3d> points,
                                const Eigen::Vector3d& direction) {
  return *std::ranges::max_element(points, {},
                                   [&](const Eigen::Vector3d& p) { return direction.dot(p); });
}

/// The vector from the hull of `points` to `p`: from its nearest point or, if the search ends
/// early, from a point near that; it ends once `p` is known to be within `margin` (m) of the hull.
/// Zero if p is inside.
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
    if (tetrahedron_contains(base, next, p)) {
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
  return offset;
}

std::vector<Eigen::Vector3d> extremes(std::span<const Eigen::Vector3d> vertices) {
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        const Eigen::Vector3d& point = farthest(vertices, {x, y, z});
        if (std::ranges::find(points, point) == points.end()) {
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

/// Vertices whose hull contains the others to within `left_out` (m).
struct Chosen {
  std::vector<Eigen::Vector3d> points;
  double left_out = 0.0;
};

// Returns nothing if there are too many.
std::optional<Chosen> choose(std::span<const Eigen::Vector3d> vertices, double margin) {
  Chosen chosen{extremes(vertices)};
  std::vector<Eigen::Vector3d>& points = chosen.points;
  for (const Eigen::Vector3d& vertex : vertices) {
    Eigen::Vector3d offset = escape(points, vertex, margin);
    while (offset.norm() > margin) {
      if (points.size() >= kMostPoints) {
        return std::nullopt;
      }
      const Eigen::Vector3d& beyond = farthest(vertices, offset);
      const bool known = std::ranges::find(points, beyond) != points.end();
      points.push_back(known ? vertex : beyond);
      offset = known ? Eigen::Vector3d::Zero() : escape(points, vertex, margin);
    }
    chosen.left_out = std::max(chosen.left_out, offset.norm());
  }
  return chosen;
}

}  // namespace

ConvexCover::ConvexCover(const TriangleMesh& mesh, double margin) {
  std::optional<Chosen> chosen = choose(mesh.vertices, margin);
  while (!chosen) {
    margin = std::max(2.0 * margin, kLeastMargin);
    chosen = choose(mesh.vertices, margin);
  }
  std::vector<Eigen::Vector3d>& points = chosen->points;
  constexpr float kRounding = 1e-6F;  // of the coordinates: that of single precision
  float largest = 0.0F;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    largest = std::max(largest, static_cast<float>(p.lpNorm<Eigen::Infinity>()));
    sum += p;
  }
  middle_ = (sum / static_cast<double>(points.size())).cast<float>();
  lower_ = upper_ = points.front().cast<float>();
  margin_ = static_cast<float>(chosen->left_out) + kRounding * largest;

  count_ = points.size();
  points.resize((count_ + kVectorWidth - 1) / kVectorWidth * kVectorWidth, points.back());
  for (const Eigen::Vector3d& p : points) {
    lower_ = lower_.cwiseMin(p.cast<float>());
    upper_ = upper_.cwiseMax(p.cast<float>());
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

}  // namespace handway::geometric
