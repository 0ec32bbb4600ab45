#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/export.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Result of checking a straight motion between two configurations.
struct EdgeResult {
  bool free = false;
  /// If not free, and settled: the pair that touches, or is closer than the resolution, …
  std::optional<int> pair;
  double at = 0.0;           ///< … and where on the edge, in [0, 1].
  std::uint64_t checks = 0;  ///< Configurations checked.
};

/// Finest resolution, m: if a pair is nearer than twice of it at an end, an edge can't be certified
/// to leave the end.
inline constexpr double kLeastResolution = 1e-6;

/// Start or goal of motions, with the pairs that are so near in it that edges need a finer
/// resolution there.
struct EdgeEnd {
  /// A pair of bodies that is near in this configuration.
  struct NearPair {
    int pair;
    double distance;  ///< m
    /// Distance (m) that edges keep from it next to the end: half of `distance`.
    [[nodiscard]] double resolution() const { return 0.5 * distance; }
  };
  Configuration q;
  std::vector<NearPair> near;

  /// The nearest pair, if any.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const NearPair* nearest() const;
  /// Returns the resolution near the end, m, for edges of resolution `elsewhere`.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT double resolution(double elsewhere) const;
};

/// @param q free of collision. @param resolution m, of edges; pairs nearer than twice of it count.
/// @param margin m; pairs that have to keep it and are less than four resolutions beyond it, too.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT EdgeEnd make_edge_end(CollisionChecker& checker,
                                                             const Configuration& q,
                                                             double resolution,
                                                             double margin = 0.0);

/// Decides whether the straight motion between two configurations is free: for every configuration
/// on it and not only for samples.
///
/// A pair is free on a stretch if its distance in the middle exceeds, by the resolution, its
/// largest loss towards either end (bounded motion); or if a plane separates the hulls of its
/// bodies by the resolution, as far as they come from the middle to either end (bounded bend). The
/// second settles long stretches on which bodies slide along each other. Stretches that neither
/// settles are halved, level by level, so that configurations are visited in the order of the Van
/// der Corput sequence's levels. A pair that is still undecided when it can move less than the
/// resolution is closer than one and a half of it: the edge is refused. On a free edge, every pair
/// that moves keeps the resolution as its distance everywhere.
///
/// Around ends with near pairs (set_ends()) the resolution of these pairs is smaller: half of their
/// distance there, plus a hundredth of the distance that the pair can have moved since. So it is
/// the usual one again where it can have moved by a hundred resolutions.
///
/// With a margin, the robot moreover keeps that distance from all bodies but its own. Next to an
/// end where a pair is nearer, it keeps half of the distance there, plus a fiftieth of the distance
/// that the pair can have moved since.
///
/// Constraints are held in the same way, on every configuration of a free edge: the resolution is
/// the remaining angle (rad) or distance to a region's side.
///
/// Source: Schwarzer, Saha, Latombe 2005 (see MotionBound).
class HANDWAY_GEOMETRIC_EXPORT ContinuousCollisionChecker {
 public:
  /// @param checker used for all queries; must outlive this object.
  /// @param resolution (m) > 0.
  ContinuousCollisionChecker(CollisionChecker& checker, std::shared_ptr<const MotionBound> motion,
                             double resolution);

  /// Ends checks early once `stop` returns true; it is called every few configurations, and once at
  /// the beginning of each check. Empty: checks never end early.
  void stop_when(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Sets the ends near which resolutions and the margin shrink, also of edges that only pass by.
  void set_ends(std::vector<EdgeEnd> ends);

  /// Sets the distance of the robot from all else, m, ≥ 0.
  void set_margin(double margin) { margin_ = margin; }

  /// From now on pairs keep three fifths of all this. Every piece of an edge that was found free
  /// before is then free, too, however it is cut: for checks of planned paths. Otherwise a piece
  /// may be refused where the edge passes closer than one and a half of the resolution.
  void accept_pieces() { kept_ = 0.6; }

  /// A pair that does not keep the margin at `q`.
  [[nodiscard]] std::optional<int> too_near(const Configuration& q);

  /// @param most_checks largest number of configurations: an edge that they do not settle is
  /// reported as not free, without a pair; so is one that was stopped.
  /// @pre both ends are free of collision.
  [[nodiscard]] EdgeResult check(
      const Configuration& from, const Configuration& to,
      std::uint64_t most_checks = std::numeric_limits<std::uint64_t>::max());

  /// Checks the motion of some pairs alone, as if there were no others: an edge is free if and only
  /// if it is for every pair on its own.
  [[nodiscard]] EdgeResult check_among(
      std::span<const int> pairs, const Configuration& from, const Configuration& to,
      std::uint64_t most_checks = std::numeric_limits<std::uint64_t>::max());

  /// The smallest distance (m) of any pair on the whole path, but not above `enough`: a lower
  /// bound, below the true one by at most `tolerance` (m) or by at most `share` of it,
  /// whichever is more. Branch and bound over the same stretches, once all waypoints and a few
  /// places between them were looked at. If stopped, it returns at most the least resolution, which
  /// every free edge keeps.
  /// @pre the edges between the waypoints are free.
  [[nodiscard]] NamedPair clearance(std::span<const Configuration> waypoints, double enough,
                                    double tolerance, double share = 0.0);

  [[nodiscard]] double resolution() const { return resolution_; }

 private:
  /// @param list_pairs sets the pairs to check once the middle of the edge is in place.
  [[nodiscard]] EdgeResult search(const Configuration& from, const Configuration& to,
                                  std::uint64_t most_checks,
                                  const std::function<void(PairIndices&)>& list_pairs);
  [[nodiscard]] bool is_stopped(std::uint64_t checks) const;

  /// Returns the distance that the pair requires (m) far from the ends.
  [[nodiscard]] double far_from_ends(int pair) const;
  /// Returns the distance (m) required around `middle`, up to where the pair moves by `motion` (m).
  [[nodiscard]] double required(int pair, const Configuration& middle, double motion) const;

  /// Returns whether the pair is likely to be farther apart than `distance`, in the configuration
  /// in place, as the next two. Pairs with large requirements may be reported closer than they are.
  /// @param quick the pair's quick bound, m.
  [[nodiscard]] bool is_out_of_reach(int pair, double distance, double quick) const;
  [[nodiscard]] Proximity proximity_of_spheres(int pair, double quick);
  /// @param half half of the stretch, as a share of the edge. @param need possible approach on it,
  /// m.
  /// @param required distance to keep nevertheless, m.
  [[nodiscard]] Proximity proximity_within(int pair, double half, double need, double required);
  /// CollisionChecker::pair_bound_along() of the motion on the edge, if the distance is `likely`
  /// (m) enough for it; else 0.
  [[nodiscard]] double bound_along(int pair, double half, double enough, double likely);

  struct Clearance;  // what clearance() has found so far
  void look_at(const Configuration& q, Clearance& found);
  void look_along(const Configuration& from, const Configuration& to, Clearance& found);
  /// Returns whether the pair is settled on a stretch of half length `half` whose middle is the
  /// configuration in place.
  [[nodiscard]] bool settle(int pair, double half, Clearance& found);

  struct Stretch {
    double middle;
    double half;
    std::size_t first;  ///< Index of its first pair in the level's list.
    std::size_t count;
  };

  CollisionChecker& checker_;
  std::shared_ptr<const MotionBound> bounds_;
  EdgeMotion motion_;
  double resolution_;
  double margin_ = 0.0;
  double kept_ = 1.0;          ///< Share of all resolutions and the margin.
  std::vector<EdgeEnd> ends_;  ///< Ends that have near pairs.
  std::function<bool()> stop_;
};

}  // namespace handway::geometric
