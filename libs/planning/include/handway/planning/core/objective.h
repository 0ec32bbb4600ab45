#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>

namespace handway::planning {

/// Weights of the properties of a path in its cost; means are over its length.
struct ObjectiveWeights {
  double length = 1.0;          ///< Per length in joints normalised to [0, 1].
  double human_likeness = 0.0;  ///< Per mean distance of the hand from the PMD subspace.
  double clearance = 0.0;       ///< Per mean missing share of kFarClearance.
  double duration = 0.0;        ///< Per second.

  friend bool operator==(const ObjectiveWeights&, const ObjectiveWeights&) = default;
};

/// Goal of path optimisation.
enum class ObjectivePreset {
  kHumanLike,  ///< The hand stays near the PMD subspace; without a basis as kShortest.
  kShortest,
  kSafest,   ///< Far from obstacles.
  kFastest,  ///< In the least time under the velocity limits.
  kCustom,   ///< ObjectiveSettings::custom.
};

/// A planner's choice of an objective.
struct ObjectiveSettings {
  int preset = static_cast<int>(ObjectivePreset::kHumanLike);  ///< An ObjectivePreset.
  ObjectiveWeights custom;

  [[nodiscard]] HANDWAY_PLANNING_EXPORT ObjectiveWeights
  weights(const PlanningProblem& problem) const;
};

/// Default of a missing velocity limit, rad/s or m/s.
inline constexpr double kDefaultVelocity = 1.0;

/// Time of the straight motion from `from` to `to` with one joint at its velocity limit, s.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double least_duration(const geometric::RobotModel& model,
                                                            const Configuration& from,
                                                            const Configuration& to);

/// Cost terms of motions; of several motions these add up.
struct MotionSums {
  double length = 0.0;             ///< In joints normalised to [0, 1].
  double outside = 0.0;            ///< Distance of the hand from the PMD subspace, times length.
  double missing_clearance = 0.0;  ///< Missing share of kFarClearance, times length.
  double duration = 0.0;           ///< See least_duration(), s.

  /// @param times how often it counts: -1 takes it away again.
  MotionSums& add(const MotionSums& other, double times = 1.0);
};

/// The cost of paths of a problem: a weighted sum of length, mean distance of the hand from the PMD
/// subspace, mean missing clearance and duration.
///
/// For one thread.
class HANDWAY_PLANNING_EXPORT Objective {
 public:
  /// A configuration with the data for its costs.
  struct Point {
    Configuration q;
    Eigen::VectorXd joints;   ///< Normalised to [0, 1].
    Eigen::VectorXd outside;  ///< From the PMD subspace to the hand's posture; empty: no basis.

    /// The distance of the hand from the PMD subspace.
    [[nodiscard]] double distance() const { return outside.norm(); }
    /// In normalised joints.
    [[nodiscard]] double distance_to(const Point& other) const {
      return (other.joints - joints).norm();
    }
  };

  /// @param problem outlives this. Without a basis `human_likeness` has no effect.
  Objective(const PlanningProblem& problem, const ObjectiveWeights& weights);

  [[nodiscard]] const ObjectiveWeights& weights() const { return weights_; }
  [[nodiscard]] Point point(const Configuration& q) const;
  [[nodiscard]] Point point_of_joints(Eigen::VectorXd joints) const;

  /// Measures the straight motion: its length, and all terms that have a weight.
  [[nodiscard]] MotionSums measure(const Point& from, const Point& to);

  /// Returns the cost of a whole path.
  [[nodiscard]] double cost(const MotionSums& path) const;
  [[nodiscard]] double cost(const Path& path);

  /// Returns `at` with its hand moved by this share of the distance to the closest posture of the
  /// PMD subspace; the arm as it is. @pre the problem has a basis.
  [[nodiscard]] Point towards_subspace(const Point& at, double share) const;

  /// Returns `at` with its hand moved inside the subspace, or in parallel to it, joints clamped to
  /// their limits. @param step shape [basis dimension], in half-sides λ of the axes. @pre the
  /// problem has a basis.
  [[nodiscard]] Point moved_along_subspace(const Point& at, const Eigen::VectorXd& step) const;
  /// Axes of the subspace. @pre the problem has a basis.
  [[nodiscard]] int subspace_dimension() const { return problem_.basis->dimension(); }

  /// Returns `at` with the hand as in `hand`.
  [[nodiscard]] Point with_hand(const Point& at, const Point& hand) const;

  /// MotionSums::outside of a path on which the hand goes straight from the start to the subspace,
  /// stays in it and leaves it straight for the goal: the least of all paths between these ends.
  [[nodiscard]] static double forced_outside(const Point& start, const Point& goal);

  /// A cost that no path from `start` to `goal` is below: that of the straight motion with the hand
  /// as in forced_outside() and everything else far away, or of a longer one if its mean distance
  /// from the subspace is lower.
  [[nodiscard]] double least_cost(const Configuration& start, const Configuration& goal) const;

  /// Number of distance queries for clearance so far.
  [[nodiscard]] std::uint64_t distance_queries() const { return distance_queries_; }

 private:
  [[nodiscard]] Point point_at(Configuration q, Eigen::VectorXd joints) const;
  [[nodiscard]] double missing_clearance(const Point& from, const Point& to, double length);

  const PlanningProblem& problem_;
  ObjectiveWeights weights_;
  std::optional<sampling::PostureSubspace> subspace_;
  Eigen::MatrixXd axes_;  ///< Subspace's axes times half-sides, shape [joints, dimension].
  std::unique_ptr<geometric::CollisionChecker> checker_;  ///< Null: clearance has no weight.
  std::uint64_t distance_queries_ = 0;
};

/// Properties of a path that objectives are made from.
struct PathQuality {
  /// Likeness of the hand along the path; means are over its length.
  struct HumanLikeness {
    double mean = 0.0;     ///< Distance from the PMD subspace.
    double largest = 0.0;  ///< Largest distance, the ends' stretches excepted.
    /// Share of the length beyond kNearSubspace, the ends' stretches excepted.
    double share_beyond = 0.0;
    /// The mean of a path of this length on which the hand goes straight to the subspace, stays in
    /// it and leaves it for the goal: the least mean with these ends.
    double forced = 0.0;
    double mahalanobis_mean = 0.0;  ///< Mean Mahalanobis distance from recordings.
    double mahalanobis_largest = 0.0;
  };

  double length = 0.0;                          ///< Joints normalised to [0, 1].
  std::optional<HumanLikeness> human_likeness;  ///< Empty without a basis.
  /// Clearance from all but the robot itself, m; kFarClearance: that or more.
  double least_clearance = 0.0;
  double mean_clearance = 0.0;  ///< Mean over the length, each at most kFarClearance.
  double duration = 0.0;        ///< s, as least_duration().
};

/// A hand nearer to the PMD subspace than this counts as in it; normalised joints.
inline constexpr double kNearSubspace = 0.05;

/// Integrals by the trapezium rule on parts of at most 0.02; clearance at their ends. An end's
/// stretch is the part of the path next to it on which the hand approaches the subspace (its
/// distance falls by half of the length at least): the start and the goal are given.
/// @throws std::invalid_argument for a path without waypoints.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PathQuality path_quality(const PlanningProblem& problem,
                                                               const Path& path);

}  // namespace handway::planning
