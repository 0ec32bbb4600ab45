#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/export.h"

#include <memory>
#include <optional>
#include <span>

namespace handway::geometric {

class NarrowPhaseQuery;

/// The default checker: gives FclChecker's answers, most of them from bounding spheres or cached
/// distances alone, the rest from the triangles within the query's distance. Only pairs that seem
/// to touch go to FCL.
class HANDWAY_GEOMETRIC_EXPORT ExactCollisionChecker final : public CollisionChecker {
 public:
  /// @throws PreparationStopped if `preparation` is stopped.
  explicit ExactCollisionChecker(std::shared_ptr<const CollisionWorld> world,
                                 const Preparation& preparation = {});
  ~ExactCollisionChecker() override;

  [[nodiscard]] std::unique_ptr<CollisionChecker> clone() const override;

 private:
  struct Volumes;  // immutable, shared by clones
  struct Scratch;  // of one thread
  struct UndecidedPair;

  ExactCollisionChecker(const ExactCollisionChecker& other);
  void do_place() override;
  [[nodiscard]] bool do_pair_collides(int pair) override;
  [[nodiscard]] double do_pair_distance(int pair, double enough) override;
  [[nodiscard]] DistanceRange do_pair_distance_range(int pair, double enough,
                                                     double share) override;
  [[nodiscard]] Proximity do_pair_proximity(int pair, double tolerance) override;
  [[nodiscard]] bool do_pair_is_nearer_than(int pair, double tolerance) override;
  [[nodiscard]] double do_pair_bound(int pair, double enough) override;
  [[nodiscard]] double do_pair_bound_along(int pair, const PairMotion& motion, double half,
                                           double enough) override;
  [[nodiscard]] double do_pair_quick_bound(int pair) override;
  void do_near_pairs(double distance, PairIndices& pairs) override;
  void do_closest_first(double distance, PairIndices& pairs) override;
  [[nodiscard]] std::optional<int> do_first_collision(int hint) override;

  [[nodiscard]] NarrowPhaseQuery query(int pair, std::span<const Pose> X_WBody);

  /// A lower bound (m) of the distance of the pair's surfaces, from one sphere or box per body.
  [[nodiscard]] double root_bound(int pair) const;

  /// The distance (m) below which the pair collides.
  [[nodiscard]] double collision_distance(int pair) const;

  /// The proximity of a pair whose bounding volumes leave it undecided.
  [[nodiscard]] Proximity nearby_proximity(int pair, double tolerance);

  /// Tests the triangles, and then whether one body contains the other.
  /// @param surfaces the pair's query.
  [[nodiscard]] Proximity exact_proximity(int pair, double tolerance, NarrowPhaseQuery& surfaces);

  /// Returns whether a piece of either body is inside of the other, tested after the surfaces,
  /// which do not touch.
  [[nodiscard]] bool is_contained(int pair, const NarrowPhaseQuery& surfaces) const;

  /// Returns whether both bodies move and their boxes are at least `distance` (m) apart. Fixed
  /// bodies are mostly large and hollow, so their boxes are not tested.
  [[nodiscard]] bool boxes_are_apart(int pair, double distance);

  /// Returns whether cached distances or the boxes show that the pair is `distance` (m) apart.
  [[nodiscard]] bool is_separated(int pair, double distance);

  /// Returns whether the pair certainly touches; if that takes more than the quick test, the pair
  /// joins the undecided pairs.
  [[nodiscard]] bool touches_quickly(int pair);
  /// Returns whether one body's surface certainly cuts one of a few balls inside the other.
  [[nodiscard]] bool surely_overlaps(int pair, const NarrowPhaseQuery& surfaces) const;
  /// Returns whether the pair collides, by its triangles where they matter.
  [[nodiscard]] bool touches_exactly(int pair);

  /// A lower bound from the pair's table of distances, if it has one; else 0.
  [[nodiscard]] double cached_distance(int pair);

  /// FCL's answer for the pair in the present configuration.
  [[nodiscard]] bool touches(int pair) const;

  std::shared_ptr<const Volumes> volumes_;
  std::unique_ptr<Scratch> scratch_;
};

/// Checkers that give the same answers.
enum class CheckerKind {
  kFast,           ///< ExactCollisionChecker.
  kFcl,            ///< FclChecker.
  kFclBroadphase,  ///< FclBroadphaseChecker.
};

/// @param kind the default of all programs is exact and fast.
/// @throws PreparationStopped if `preparation` is stopped.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world, CheckerKind kind = CheckerKind::kFast,
    const Preparation& preparation = {});

}  // namespace handway::geometric
