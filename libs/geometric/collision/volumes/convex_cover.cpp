#include "collision/volumes/convex_cover.h"

#include "collision/volumes/box_tree.h"
#include "math/vector_units.h"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr int kPlanes = 10;            // tried between two hulls

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

namespace {

constexpr double kConverged = 0.02;  // share of the distance between its bounds at which to stop

/// Searches for the nearest points of two convex sets A and B. Each step gives a direction and the
/// gap (m) between the sets along it. Ends when `is_settled(direction, gap)`, when the sets are
/// nearer than `needed` (m), or after kPlanes steps.
/// @param nearest offset of a point of A from a point of B, m. @param likely the first direction.
/// @param farthest_apart `farthest_apart(n)` is the offset of A's first point along n from B's last
/// one.
template <typename FarthestApart, typename IsSettled>
void search_plane(Eigen::Vector3d nearest, const Eigen::Vector3d& likely, double needed,
                  const FarthestApart& farthest_apart, const IsSettled& is_settled) {
  Simplex simplex{nearest, nearest, nearest};
  for (int plane = 0; plane < kPlanes; ++plane) {
    const double distance = nearest.norm();
    if (distance <= needed) {
      return;
    }
    const Eigen::Vector3d normal = plane == 0 ? likely.normalized() : nearest / distance;
    const Eigen::Vector3d between = farthest_apart(normal);
    const double gap = normal.dot(between);
    if (is_settled(normal, gap) || distance - gap <= kConverged * distance ||
        contains(simplex, between, Eigen::Vector3d::Zero())) {
      return;
    }
    const Simplex base = simplex;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      Simplex face = base;
      face[k] = between;
      const Eigen::Vector3d on_face = nearest_on_triangle(face, Eigen::Vector3d::Zero());
      if (on_face.squaredNorm() < least) {
        least = on_face.squaredNorm();
        nearest = on_face;
        simplex = face;
      }
    }
    if (least >= distance * distance) {
      return;
    }
  }
}

// The direction in which a point outside of B's box is nearest to it; for a point in it, the
// direction from B's middle.
Eigen::Vector3f away_from(const ConvexCover& b, const Eigen::Vector3f& p) {
  const Eigen::Vector3f beyond = p - b.nearest_in_box(p);
  return beyond.isZero(0.0F) ? p - b.middle() : beyond;
}

}  // namespace

HullGap hull_gap(const ConvexCover& a, const ConvexCover& b, const FloatPose& X_BA, float enough) {
  using RowMajor = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> R(X_BA.R.data());
  const Eigen::Map<const Eigen::Vector3f> p(X_BA.p.data());
  const float lost = a.margin() + b.margin() + X_BA.rounding;
  HullGap most;
  Eigen::Vector3f p_BA;
  const auto farthest_apart = [&](const Eigen::Vector3d& normal) -> Eigen::Vector3d {
    const Eigen::Vector3f n = normal.cast<float>();
    p_BA = R * a.support(-(R.transpose() * n)) + p;
    return (p_BA - b.support(n)).cast<double>();
  };
  const auto is_settled = [&](const Eigen::Vector3d& /*normal*/, double gap) {
    if (const float distance = static_cast<float>(gap) - lost; distance > most.distance) {
      most = {distance, p_BA};
    }
    return most.distance >= enough;
  };
  const Eigen::Vector3f middle = R * a.middle() + p;
  search_plane((middle - b.middle()).cast<double>(), away_from(b, middle).cast<double>(),
               static_cast<double>(lost), farthest_apart, is_settled);
  return most;
}

namespace {

// The hull's point that is farthest along `direction`.
Eigen::Vector3d farthest_of(const MovingHull& moving, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d turned = moving.X_WHull.linear().transpose() * direction;
  return moving.X_WHull * moving.hull.support(turned.cast<float>()).cast<double>();
}

// A lower bound of the coordinates (m) along `direction` of all points, once the hull has moved by
// `share` of the edge without a bend.
double least_along(const MovingHull& moving, const Eigen::Vector3d& direction, double share) {
  const Eigen::Vector3d along = direction + share * direction.cross(moving.w);
  return along.dot(farthest_of(moving, -along)) + share * direction.dot(moving.v) -
         static_cast<double>(moving.hull.margin()) * along.norm();
}

}  // namespace

double hull_gap_along(const MovingHull& a, const MovingHull& b, double half, double enough) {
  constexpr double kRounding = 1e-6;  // m
  const double lost = 0.5 * half * half * (a.bend + b.bend) + kRounding;
  const double needed = enough + lost;
  double most = 0.0;
  const auto farthest_apart = [&](const Eigen::Vector3d& normal) -> Eigen::Vector3d {
    return farthest_of(a, -normal) - farthest_of(b, normal);
  };
  // Along a normal the gap is a concave function of the share of the edge, without the bend: it is
  // least at an end of the stretch.
  const auto is_settled = [&](const Eigen::Vector3d& normal, double gap) {
    const auto gap_at = [&](double share) {
      return least_along(a, normal, share) + least_along(b, -normal, share);
    };
    if (gap > needed) {
      most = std::max(most, std::min(gap_at(-half), gap_at(half)) - lost);
    }
    return most >= enough;
  };
  const Eigen::Vector3d middle = a.X_WHull * a.hull.middle().cast<double>();
  const Eigen::Vector3d p_BMiddle = b.X_WHull.inverse(Eigen::Isometry) * middle;
  search_plane(middle - b.X_WHull * b.hull.middle().cast<double>(),
               b.X_WHull.linear() * away_from(b.hull, p_BMiddle.cast<float>()).cast<double>(),
               needed, farthest_apart, is_settled);
  return most;
}

}  // namespace handway::geometric
