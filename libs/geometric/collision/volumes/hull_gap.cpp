#include "collision/volumes/hull_gap.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/simplex.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace handway::geometric {
namespace {

constexpr int kPlanes = 10;          // tried between two hulls
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
        tetrahedron_contains(simplex, between, Eigen::Vector3d::Zero())) {
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
