#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/collision/point_motion.h"
#include "handway/geometric/export.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace handway::geometric {

/// Number of queries of each kind that a checker has answered.
struct CheckCounts {
  std::uint64_t configurations = 0;   ///< Placed configurations.
  std::uint64_t pair_collisions = 0;  ///< Collision queries of pairs.
  std::uint64_t pair_distances = 0;   ///< Distance queries of pairs.
  std::uint64_t exact_tests = 0;      ///< Pair queries answered on triangles.

  CheckCounts& operator+=(const CheckCounts& other) {
    configurations += other.configurations;
    pair_collisions += other.pair_collisions;
    pair_distances += other.pair_distances;
    exact_tests += other.exact_tests;
    return *this;
  }
};

/// The two features between which a distance is measured, m.
struct DistanceRange {
  double lower = 0.0;
  double upper = std::numeric_limits<double>::infinity();
};

/// Result of a tolerance query.
enum class Proximity {
  kClear,            ///< At least the tolerance apart.
  kWithinTolerance,  ///< Nearer than that, without a collision.
  kCollision,        ///< In collision.
};

/// A connected piece of a body's surface inside of another body's hollow closed shape.
struct Enclosed {
  int inner = -1;  ///< Index of the inner body, …
  int outer = -1;  ///< … and of the outer one.
  int piece = 0;   ///< Piece of the inner body's surfaces.
  int shell = 0;   ///< Hollow shape of the outer body.

  /// Returns the key of the order.
  [[nodiscard]] std::tuple<int, int, int, int> key() const { return {inner, outer, piece, shell}; }
};

/// Answers collision queries about the pairs of a CollisionWorld.
///
/// A checker holds the state of one configuration and is for one thread; clones share the
/// immutable parts. Touching counts as collision, and so does a body inside of another one's
/// solids (see CollisionWorld): statements about touching bodies hold for both. Distances are
/// those between the surfaces minus the pair's padding, and a pair nearer than its padding counts
/// as touching.
class HANDWAY_GEOMETRIC_EXPORT CollisionChecker {
 public:
  virtual ~CollisionChecker() = default;
  CollisionChecker& operator=(const CollisionChecker&) = delete;

  [[nodiscard]] virtual std::unique_ptr<CollisionChecker> clone() const = 0;

  [[nodiscard]] const CollisionWorld& world() const { return *world_; }
  [[nodiscard]] const std::shared_ptr<const CollisionWorld>& shared_world() const { return world_; }
  [[nodiscard]] const CheckCounts& counts() const { return counts_; }
  void reset_counts() { counts_ = {}; }

  /// Places all bodies for the following queries.
  /// @param q shape [variable_count]; limits are not checked.
  /// @throws std::invalid_argument if the shape is wrong or a value is not finite.
  void place(const Configuration& q);

  /// Poses of the placed links in the robot's base frame. Shape [link_count].
  [[nodiscard]] const std::vector<Pose>& link_poses() const { return X_BL_; }

  /// Returns whether the two placed bodies of world().pairs()[pair] touch. Queries about one pair
  /// accept constraints, too; see CollisionWorld::constraints().
  [[nodiscard]] bool pair_collides(int pair);

  /// A lower bound of the distance of the pair's bodies, m: the distance itself if it is below
  /// `enough`, otherwise any value from `enough` up to it. 0 if they touch, or one contains the
  /// other, at any depth.
  [[nodiscard]] double pair_distance(int pair, double enough);

  /// The pair's distance to within a `share` of it, in [0, 1), or a value from `enough` up if it is
  /// at least that. A larger share is cheaper.
  /// @pre no constraint.
  [[nodiscard]] DistanceRange pair_distance_range(int pair, double enough, double share) {
    ++counts_.pair_distances;
    const double padding = world_->padding(pair);
    if (padding == 0.0) {
      return do_pair_distance_range(pair, enough, share);
    }
    const auto [lower, upper] = do_pair_distance_range(pair, enough + padding, 0.0);
    return {std::max(0.0, lower - padding), std::max(0.0, upper - padding)};
  }

  /// Compares the pair's distance with `tolerance` (m). Cheaper than its distance.
  [[nodiscard]] Proximity pair_proximity(int pair, double tolerance);

  /// Returns whether the pair is closer than `tolerance` (m) or in collision. Cheaper than
  /// pair_proximity().
  [[nodiscard]] bool pair_is_nearer_than(int pair, double tolerance);

  /// A cheap lower bound of the pair's distance, at most `enough`; it may be far below the
  /// distance.
  [[nodiscard]] double pair_bound(int pair, double enough) {
    if (world_->constraint(pair)) {
      return pair_distance(pair, enough);
    }
    const double padding = world_->padding(pair);
    return std::max(0.0, do_pair_bound(pair, enough + padding) - padding);
  }

  /// A lower bound of the pair's distance on a whole stretch of an edge, of which the configuration
  /// in place is the middle; 0 if none is known. The search for a better one ends at `enough` (m).
  /// @param half half of the stretch, as a share of the edge.
  [[nodiscard]] double pair_bound_along(int pair, const PairMotion& motion, double half,
                                        double enough) {
    if (world_->constraint(pair)) {
      return 0.0;
    }
    const double padding = world_->padding(pair);
    return std::max(0.0, do_pair_bound_along(pair, motion, half, enough + padding) - padding);
  }

  /// A cheap lower bound of the pair's distance, from the bounding volumes of the two
  /// bodies.
  [[nodiscard]] double pair_quick_bound(int pair) {
    const LinkConstraint* constraint = world_->constraint(pair);
    return std::max(0.0, constraint ? constraint->slack(X_BL_)
                                    : do_pair_quick_bound(pair) - world_->padding(pair));
  }

  /// Sets `pairs` to all that may be nearer than `distance` (m) by their bounding volumes, in
  /// order. In a large scene not every pair is tested. No constraints.
  void near_pairs(double distance, PairIndices& pairs) { do_near_pairs(distance, pairs); }

  /// Lists near_pairs(), the likely closest ones first where an estimate is cheap.
  void near_pairs_closest_first(double distance, PairIndices& pairs) {
    do_near_pairs(distance, pairs);
    do_closest_first(distance, pairs);
  }

  /// Index of a constraint that is violated or a pair that touches in `q`, or nothing if `q` is
  /// free.
  [[nodiscard]] std::optional<int> first_collision(const Configuration& q);

  /// Tests constraints, then `hint`, then all pairs in a fixed order: the result depends on the
  /// arguments alone. @pre 0 ≤ hint < checks, if there are any.
  [[nodiscard]] std::optional<int> first_collision(const Configuration& q, int hint);

  /// Returns the pieces inside of hollow closed shapes (objects that are not `solid`) in `q`, in
  /// order. As long nothing touches, this stays as it is: configurations in which it differs are in
  /// different components of the free space.
  /// @pre nothing touches in `q`.
  [[nodiscard]] std::vector<Enclosed> enclosed(const Configuration& q);

  /// The first of `pairs` that touches in `q`, if any.
  [[nodiscard]] std::optional<int> first_collision_among(std::span<const int> pairs,
                                                         const Configuration& q);

 protected:
  explicit CollisionChecker(std::shared_ptr<const CollisionWorld> world);
  CollisionChecker(const CollisionChecker& other);

  [[nodiscard]] const std::vector<Pose>& body_poses() const { return X_WBody_; }
  [[nodiscard]] const Configuration& configuration() const { return q_; }
  /// Returns whether a piece of either of the pair's bodies is inside of the other.
  /// @pre their surfaces do not touch.
  [[nodiscard]] bool pair_is_contained(int pair) const;
  void count_pair_collision() { ++counts_.pair_collisions; }
  void count_exact_test() { ++counts_.exact_tests; }

  /// Called after the bodies have been placed. The following queries about one pair are about its
  /// surfaces and solids, without padding.
  virtual void do_place() {}
  [[nodiscard]] virtual bool do_pair_collides(int pair) = 0;
  [[nodiscard]] virtual double do_pair_distance(int pair, double enough) = 0;
  [[nodiscard]] virtual DistanceRange do_pair_distance_range(int pair, double enough, double share);
  [[nodiscard]] virtual Proximity do_pair_proximity(int pair, double tolerance);
  [[nodiscard]] virtual bool do_pair_is_nearer_than(int pair, double tolerance) {
    return do_pair_proximity(pair, tolerance) != Proximity::kClear;
  }
  [[nodiscard]] virtual double do_pair_bound(int pair, double enough) {
    return do_pair_distance(pair, enough);
  }
  [[nodiscard]] virtual double do_pair_bound_along(int /*pair*/, const PairMotion& /*motion*/,
                                                   double /*half*/, double /*enough*/) {
    return 0.0;
  }
  [[nodiscard]] virtual double do_pair_quick_bound(int /*pair*/) { return 0.0; }
  /// Queries about all pairs take their padding into account.
  virtual void do_near_pairs(double distance, PairIndices& pairs);
  virtual void do_closest_first(double /*distance*/, PairIndices& /*pairs*/) {}
  /// Tests `hint` first, then all in a fixed order. @pre there are pairs.
  [[nodiscard]] virtual std::optional<int> do_first_collision(int hint);

 private:
  std::shared_ptr<const CollisionWorld> world_;
  Configuration q_;
  std::vector<Pose> X_BL_;
  std::vector<Pose> X_WBody_;
  CheckCounts counts_;
  int last_collision_ = 0;  ///< Tested first: neighbours in space collide in the same pair.
};

/// Two bodies by name, with their distance (m, 0 if they touch or one is inside of the other); or a
/// constraint as `a`, with `b` empty.
struct NamedPair {
  std::string a;
  std::string b;
  double distance = 0.0;
};

/// The pair world.pairs()[pair] by its bodies' names, or the constraint with that index.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT NamedPair named_pair(const CollisionWorld& world, int pair,
                                                            double distance);

/// Formats "a with b", or "constraint a".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string to_string(const NamedPair& pair);

/// Describes the conflict of `q` with a pair or constraint that first_collision() returned: "is in
/// collision: a with b", or "violates constraint a: …".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string describe_conflict(CollisionChecker& checker,
                                                                     int pair,
                                                                     const Configuration& q);

/// Describes each constraint that is violated in `q`: "constraint can upright: the axis of can is
/// 12° off, at most 10° are allowed".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> violated_constraints(
    CollisionChecker& checker, const Configuration& q);

/// Indices into world().pairs() of all that touch in `q`, in order.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PairIndices touching_pairs(CollisionChecker& checker,
                                                                  const Configuration& q);

/// All pairs that touch in `q`, in pair order.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<NamedPair> find_collisions(
    CollisionChecker& checker, const Configuration& q);

/// The closest pair in `q`; a distance above `enough` may be reported as `enough`. A world without
/// pairs has an infinite distance.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT NamedPair
find_clearance(CollisionChecker& checker, const Configuration& q,
               double enough = std::numeric_limits<double>::infinity());

/// Returns whether any pair is closer than `distance` (m) in `q`: the third of PQP's queries.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_closer_than(CollisionChecker& checker,
                                                           const Configuration& q, double distance);

}  // namespace handway::geometric
