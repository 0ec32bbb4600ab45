#pragma once

#include "collision/cache/surface.h"
#include "collision/volumes/sphere_tree.h"
#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/narrow_phase/closest_points.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::geometric {

/// Returns whether `a` gives the spheres and `b` the distance field of a query about both;
/// otherwise the query is faster the other way round.
[[nodiscard]] bool gives_spheres(const Surface& a, const Surface& b);

/// Queries about two surfaces in one position: spheres of A in the distance field of B leave a few
/// triangles, which are compared one by one.
class NarrowPhaseQuery {
 public:
  /// @param X_WA,X_WB must outlive this object.
  /// @param near buffer for triangles to compare; must outlive this object.
  NarrowPhaseQuery(const Surface& a, const Surface& b, const Pose& X_WA, const Pose& X_WB,
                   std::vector<std::uint32_t>& near);

  /// A lower bound (m) of the distance, at most `enough`, from spheres alone; 0 if they are not
  /// sufficient. @param effort number of sphere nodes to visit.
  [[nodiscard]] double bound(double enough, int effort);

  /// The distance (m) to within a `share` of it, or from `enough` up if the surfaces are at least
  /// that far apart; 0 where they surely cross. A smaller `enough` ends sooner.
  [[nodiscard]] DistanceRange distance(double enough, double share = 0.0);

  /// The closest points of the surfaces, in the world; nothing if they touch or are `enough` (m) or
  /// more apart.
  [[nodiscard]] std::optional<ClosestPoints> closest_points(double enough);

  /// Returns whether the sphere around A allows surfaces closer than `tolerance` (m).
  [[nodiscard]] bool may_be_nearer_than(double tolerance);

  /// Distance of the middle of A's sphere from B by the field, as a share of the radius. @pre
  /// may_be_nearer_than()
  [[nodiscard]] float relative_distance() const { return relative_distance_; }

  /// Returns whether B's surface certainly cuts a ball inside A. @pre may_be_nearer_than()
  [[nodiscard]] bool cuts(const InnerBall& ball) const;

  /// Returns whether the surfaces are closer than `tolerance` (m).
  [[nodiscard]] bool is_nearer_than(double tolerance);

  /// Compares the distance of the surfaces with `tolerance` (m). "Touching" below kTouch.
  [[nodiscard]] Proximity proximity(double tolerance);

  /// Returns whether the sphere around A was found clear of B's surface: then A is inside or
  /// outside of each piece of B as a whole, as the sphere's centre is, and B is not inside A.
  [[nodiscard]] bool root_is_clear() const { return root_is_clear_; }

  /// The centre of A's sphere in B's frame, m. @pre root_is_clear()
  [[nodiscard]] const Eigen::Vector3d& root_centre() const { return p_BRoot_; }

  /// Returns whether the hulls are known to be separated, so that neither body is in the other.
  [[nodiscard]] bool hulls_are_apart() const { return hull_gap_ > 0.0; }

  /// Returns whether triangles were found that certainly intersect.
  [[nodiscard]] bool surely_crosses() const { return least_ <= 0.0; }

  /// Returns whether triangles were compared.
  [[nodiscard]] bool was_exact() const { return exact_; }

 private:
  /// Starts a search below `least` (m), with each distance known to within 1 - `keep` of it.
  void start(double least, double keep = 1.0);
  void found(double distance);
  /// Returns whether the sphere around A may be nearer than `reach_`; then X_BA is known.
  [[nodiscard]] bool root_is_near();
  void visit_all();
  void bound_node(std::uint32_t node);
  void visit(std::uint32_t node);
  /// Returns whether the hulls are known to be at least `reach_` apart.
  [[nodiscard]] bool separated_by_plane();
  /// Returns whether the hulls are apart, but one of A's points is likely to be nearer to B than
  /// `reach_`, so that spheres would hardly tell more.
  [[nodiscard]] bool hulls_show_nearer() const;
  /// Returns whether the hulls keep `reach_`, searching for a separating plane only once.
  [[nodiscard]] bool hulls_keep_apart();
  void compare(std::uint32_t leaf, const Eigen::Vector3d& centre, double radius);
  /// Returns whether the field shows that a triangle, in B's frame, is at least `reach_` away.
  [[nodiscard]] bool field_keeps_apart(const TriangleCorners& s) const;
  /// Takes the distance of two triangles, in B's frame, into account.
  void measure(const TriangleCorners& s, const TriangleCorners& t);
  /// Compares with the triangles in `near_`.
  void compare_triangle(const TriangleCorners& s);

  const Surface& a_;
  const Surface& b_;
  const Pose& X_WA_;
  const Pose& X_WB_;
  bool placed_ = false;
  bool root_is_clear_ = false;
  Eigen::Vector3d p_BRoot_;
  Pose X_BA_;
  FloatPose moves_;
  double least_ = 0.0;    ///< The least distance known so far, or the limit.
  double reach_ = 0.0;    ///< Distances from here up are ignored.
  double keep_ = 1.0;     ///< Share of the least distance found: its precision.
  double ends_at_ = 0.0;  ///< The search ends below this.
  int effort_ = 0;
  int patience_ = 0;
  bool exact_ = false;
  bool tried_hulls_ = false;
  float relative_distance_ = 0.0F;
  ClosestPoints closest_B_;           ///< Points at `least_` of the triangles compared, in B.
  double hull_gap_ = 0.0;             ///< m: the hulls are known to be that far apart.
  Eigen::Vector3f p_BNext_;           ///< Point of A's hull next to B's. @pre hull_gap_ > 0
  std::vector<std::uint32_t>& near_;  ///< Triangles of B that a leaf is compared with.
};

}  // namespace handway::geometric
