#include "collision/narrow_phase/narrow_phase_query.h"

#include "collision/volumes/hull_gap.h"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace handway::geometric {
namespace {

constexpr int kPatience = 3;         // nodes visited on the field's word alone
constexpr std::size_t kPlainer = 8;  // times fewer triangles
constexpr float kTiny = 0.4F;        // share of the other body's size

/// @param points set to the closest points of the triangles, in their common frame.
double triangle_distance(const TriangleCorners& s, const TriangleCorners& t,
                         ClosestPoints& points) {
  return fcl::detail::TriangleDistance<double>::triDistance(s.data(), t.data(), points.p_WA,
                                                            points.p_WB);
}

// Removes the sphere with the least bound.
std::size_t take_nearest(SphereBounds& bounds) {
  std::size_t nearest = 0;
  float least = INFINITY;
  for (std::uint32_t bits = bounds.near; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    if (bounds.bound[k] < least) {
      least = bounds.bound[k];
      nearest = k;
    }
  }
  bounds.near &= ~(1U << nearest);
  return nearest;
}

}  // namespace

// A mesh's spheres are tested against a primitive, whose distance is exact everywhere. Otherwise
// the smaller body's spheres are tested in the larger one's field. But the field of a much
// simpler mesh has larger cells, and is better if the body is not tiny.
bool gives_spheres(const Surface& a, const Surface& b) {
  const bool a_is_primitive = a.field.primitive().has_value();
  if (a_is_primitive != b.field.primitive().has_value()) {
    return !a_is_primitive;
  }
  const bool a_is_smaller = a.cover.root().radius <= b.cover.root().radius;
  const Surface& smaller = a_is_smaller ? a : b;
  const Surface& larger = a_is_smaller ? b : a;
  const bool is_plainer =
      kPlainer * smaller.mesh->triangles.size() < larger.mesh->triangles.size() &&
      kTiny * larger.cover.root().radius < smaller.cover.root().radius;
  return a_is_smaller != is_plainer;
}

NarrowPhaseQuery::NarrowPhaseQuery(const Surface& a, const Surface& b, const Pose& X_WA,
                                   const Pose& X_WB, std::vector<std::uint32_t>& near)
    : a_(a), b_(b), X_WA_(X_WA), X_WB_(X_WB), near_(near) {}

bool NarrowPhaseQuery::root_is_near() {
  const BoundingSphere& root = a_.cover.root();
  const Eigen::Vector3d centre = X_WA_ * root.centre.cast<double>() - X_WB_.translation();
  p_BRoot_ = X_WB_.linear().transpose() * centre;
  const Eigen::Vector3f p_BRoot = p_BRoot_.cast<float>();
  const float rounding = kMoveRounding * p_BRoot.lpNorm<1>() + b_.field.rounding();
  const float bound = b_.field.bound(p_BRoot);
  const float least = bound - root.radius - rounding;
  root_is_clear_ = least > 0.0F;
  if (least >= reach_) {
    return false;
  }
  relative_distance_ = bound / root.radius;
  if (!placed_) {
    placed_ = true;
    X_BA_ = X_WB_.inverse(Eigen::Isometry) * X_WA_;
    moves_ = FloatPose(X_BA_, root.centre.lpNorm<1>() + root.radius);
    moves_.rounding += b_.field.rounding();
  }
  return true;
}

void NarrowPhaseQuery::start(double least, double keep) {
  least_ = least;
  reach_ = least;
  keep_ = keep;
}

void NarrowPhaseQuery::found(double distance) {
  if (distance < least_) {
    least_ = distance;
    reach_ = keep_ * distance;
  }
}

double NarrowPhaseQuery::bound(double enough, int effort) {
  start(enough);
  effort_ = effort;
  if (root_is_near() && !separated_by_plane()) {
    if (hulls_show_nearer()) {
      return hull_gap_;
    }
    bound_node(0);
  }
  return std::min(enough, std::max(hull_gap_, least_));
}

void NarrowPhaseQuery::bound_node(std::uint32_t index) {
  const SphereTree::Node& node = a_.cover.node(index);
  SphereBounds bounds;
  sphere_bounds(node, b_.field, moves_, static_cast<float>(reach_), bounds);
  while (bounds.near != 0 && least_ > 0.0) {
    const std::size_t k = take_nearest(bounds);
    if (bounds.bound[k] >= reach_) {
      return;
    }
    if ((node.child[k] & SphereTree::kLeaf) != 0 || --effort_ < 0) {
      found(bounds.bound[k]);
    } else {
      bound_node(node.child[k]);
    }
  }
}

DistanceRange NarrowPhaseQuery::distance(double enough, double share) {
  start(enough, 1.0 - share);
  ends_at_ = 0.0;
  visit_all();
  return {reach_, least_ < enough ? least_ : std::numeric_limits<double>::infinity()};
}

std::optional<ClosestPoints> NarrowPhaseQuery::closest_points(double enough) {
  if (const double distance = this->distance(enough).upper; distance <= 0.0 || distance >= enough) {
    return std::nullopt;
  }
  return ClosestPoints{X_WB_ * closest_B_.p_WA, X_WB_ * closest_B_.p_WB};
}

bool NarrowPhaseQuery::may_be_nearer_than(double tolerance) {
  start(tolerance);
  return root_is_near();
}

bool NarrowPhaseQuery::cuts(const InnerBall& ball) const {
  const Eigen::Vector3d centre = X_BA_ * ball.centre.cast<double>();
  return b_.field.bound(centre.cast<float>()) < ball.radius &&
         b_.triangles->is_surely_nearer_than(centre, ball.radius);
}

bool NarrowPhaseQuery::is_nearer_than(double tolerance) {
  start(tolerance);
  ends_at_ = tolerance;
  visit_all();
  return least_ < tolerance;
}

Proximity NarrowPhaseQuery::proximity(double tolerance) {
  if (!is_nearer_than(tolerance)) {
    return Proximity::kClear;
  }
  return least_ < kTouch || is_nearer_than(kTouch) ? Proximity::kCollision
                                                   : Proximity::kWithinTolerance;
}

void NarrowPhaseQuery::visit_all() {
  patience_ = kPatience;
  if (root_is_near()) {
    visit(0);
  }
}

void NarrowPhaseQuery::visit(std::uint32_t index) {
  const SphereTree::Node& node = a_.cover.node(index);
  SphereBounds bounds;
  sphere_bounds(node, b_.field, moves_, static_cast<float>(reach_), bounds);
  while (bounds.near != 0 && least_ >= ends_at_) {
    const std::size_t k = take_nearest(bounds);
    if (bounds.bound[k] >= reach_) {
      return;
    }
    const Eigen::Vector3d centre = X_BA_ * Eigen::Vector3d(node.x[k], node.y[k], node.z[k]);
    const auto radius = static_cast<double>(node.radius[k]);
    const bool is_leaf = (node.child[k] & SphereTree::kLeaf) != 0;
    if ((is_leaf || patience_ <= 1) && hulls_keep_apart()) {
      return;
    }
    if (is_leaf) {
      compare(node.child[k] & ~SphereTree::kLeaf, centre, radius);
    } else if (--patience_ >= 0 || b_.triangles->is_nearer_than(centre, radius + reach_)) {
      visit(node.child[k]);
    }
  }
}

bool NarrowPhaseQuery::separated_by_plane() {
  const auto reach = static_cast<float>(reach_);
  const HullGap gap = hull_gap(*a_.hull, *b_.hull, moves_, reach);
  if (static_cast<double>(gap.distance) > hull_gap_) {
    hull_gap_ = static_cast<double>(gap.distance);
    p_BNext_ = gap.p_BA;
  }
  return hull_gap_ >= reach_;
}

bool NarrowPhaseQuery::hulls_show_nearer() const {
  return hull_gap_ > 0.0 && static_cast<double>(b_.field.bound(p_BNext_)) < reach_;
}

bool NarrowPhaseQuery::hulls_keep_apart() {
  if (!tried_hulls_) {
    tried_hulls_ = true;
    return separated_by_plane();
  }
  return hull_gap_ >= reach_;
}

void NarrowPhaseQuery::compare(std::uint32_t leaf, const Eigen::Vector3d& centre, double radius) {
  near_.clear();
  b_.triangles->append_within(centre, radius + reach_, near_);
  if (near_.empty()) {
    return;
  }
  for (const std::uint32_t triangle : a_.cover.triangles(leaf)) {
    TriangleCorners s = corners(*a_.mesh, triangle);
    for (Eigen::Vector3d& p : s) {
      p = X_BA_ * p;
    }
    if (!field_keeps_apart(s)) {
      exact_ = true;
      compare_triangle(s);
    }
    if (least_ < ends_at_ || least_ <= 0.0) {
      return;
    }
  }
}

bool NarrowPhaseQuery::field_keeps_apart(const TriangleCorners& s) const {
  const Eigen::Vector3d middle = (s[0] + s[1] + s[2]) / 3.0;
  const double radius =
      std::sqrt(std::max({(s[0] - middle).squaredNorm(), (s[1] - middle).squaredNorm(),
                          (s[2] - middle).squaredNorm()}));
  const double reach = reach_ + moves_.rounding;
  return static_cast<double>(b_.field.bound(middle.cast<float>())) - radius >= reach ||
         static_cast<double>(b_.field.bound(std::array<Eigen::Vector3f, 3>{
             s[0].cast<float>(), s[1].cast<float>(), s[2].cast<float>()})) >= reach;
}

void NarrowPhaseQuery::measure(const TriangleCorners& s, const TriangleCorners& t) {
  ClosestPoints points;
  const double distance = triangle_distance(s, t, points);
  if (distance < least_) {
    closest_B_ = points;
  }
  found(distance);
}

void NarrowPhaseQuery::compare_triangle(const TriangleCorners& s) {
  const TrianglePlane plane(s);
  for (const std::uint32_t other : near_) {
    const TriangleCorners t = corners(*b_.mesh, other);
    if (!plane.is_beside(t, reach_) && !TrianglePlane(t).is_beside(s, reach_)) {
      // In a search for contact, most pairs left by planes cross; otherwise hardly any.
      if (ends_at_ > 0.0 && surely_cross(s, t)) {
        found(0.0);
      } else {
        measure(s, t);
      }
      if (least_ < ends_at_ || least_ <= 0.0) {
        return;
      }
    }
  }
}

}  // namespace handway::geometric
