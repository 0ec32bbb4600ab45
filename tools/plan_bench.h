#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/dynamic_time_warping.h"
#include "plan_report.h"
#include "scene_variants.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {

/// A planner on a problem, once for each seed.
struct PlanBench {
  std::string planner;
  std::string checker;  ///< Key in checker_kinds().
  std::vector<std::uint64_t> seeds;
  std::vector<planning::PlanResult> results;  ///< One per seed, without its path's points.
  std::vector<std::size_t> path_nodes;        ///< One per seed; 0 without a path.
  std::vector<std::optional<planning::PathQuality>> qualities;  ///< One per seed, of its path.
  std::vector<std::optional<MotionMeasures>> motions;           ///< One per seed, of its path.
  std::vector<std::vector<std::string>> path_faults;            ///< One per seed, of checked paths.
  std::size_t memory = 0;                                       ///< Peak, bytes.
  std::string problem;  ///< Reason why it could not run; or empty.
};

/// Runs each of `seeds`; ends after the first if the query itself is not valid.
/// @param checked whether every path is checked again at 1 mm (planning::check_path).
/// @param recorded postures to compare hands with; may be null.
/// @param make_problem is called for every run, so that none profits from a checker's caches of
/// another.
[[nodiscard]] PlanBench bench_planner(
    planning::Planner& planner, const std::function<planning::PlanningProblem()>& make_problem,
    planning::PlanRequest request, const std::vector<std::uint64_t>& seeds, bool checked,
    const std::shared_ptr<const sampling::RecordedPostures>& recorded = nullptr);

[[nodiscard]] int solved_count(const PlanBench& bench);
/// Paths in which a check found a fault.
[[nodiscard]] int faulty_count(const PlanBench& bench);

/// The p-quantile (0 < p ≤ 1, nearest rank) of the times of planning and smoothing, s; a run
/// without a path counts as infinitely long, so that the quantile is infinite if more than 1 - p of
/// them have none.
[[nodiscard]] double time_quantile(const PlanBench& bench, double p);

/// Medians over all runs, or NaN without runs: samples drawn, configurations checked.
[[nodiscard]] double median_samples(const PlanBench& bench);
[[nodiscard]] double median_checks(const PlanBench& bench);
/// Median over the runs that found a path, or NaN.
[[nodiscard]] double median_path_nodes(const PlanBench& bench);
/// Medians over the runs that found a path, or NaN: of its length in normalised joints, and of the
/// hand's mean distance from the PMD subspace (NaN without a basis, too).
[[nodiscard]] double median_length(const PlanBench& bench);
[[nodiscard]] double median_to_subspace(const PlanBench& bench);

/// Medians over the runs that found a path of the measures of their motions; NaN where there is
/// none.
struct MotionMedians {
  double duration;  ///< s
  double hand_log_dimensionless_jerk;
  double palm_log_dimensionless_jerk;
  double hand_spectral_arc_length;
  double palm_spectral_arc_length;
  double arm_deviation;    ///< Normalised joints.
  double palm_deviation;   ///< m
  double component_error;  ///< rad
  double recorded_error;   ///< Median of recorded motions, rad.
  double warped_distance;  ///< Between motions of two seeds, normalised joints.
  double largest_warped_distance;
};

[[nodiscard]] MotionMedians motion_medians(const PlanBench& bench);

/// A variant and the runs on it.
struct VariantRuns {
  SceneVariant variant;
  std::vector<PlanBench> plans;  ///< One per planner, the default first; empty without a scene.
};

/// Runs of planners on the variants of one problem.
struct VariantBench {
  std::filesystem::path file;
  std::string target;  ///< Objects relative to which the goal is kept; may be empty.
  std::vector<VariantRuns> variants;

  [[nodiscard]] std::string name() const { return file.stem().string(); }
};

/// A variant and a seed that the default planner missed, and the planners that solved it.
struct MissedPair {
  std::string file;  ///< File of the problem.
  int variant = 0;
  std::uint64_t seed = 0;
  std::string reason;                                     ///< The default's.
  std::vector<std::pair<std::string, double>> solved_by;  ///< Other planners with their time, s.
};

/// Counts of (variant, seed) pairs.
struct VariantSummary {
  std::size_t pairs = 0;
  std::size_t solved_by_any = 0;
  std::size_t solved_by_default = 0;
  std::vector<MissedPair> missed;  ///< Missed by the default, solved by another one or not.

  VariantSummary& operator+=(const VariantSummary& other);
  /// Share of the pairs solved by any planner that the default solved; NaN if none solved any.
  [[nodiscard]] double default_share() const;
};

[[nodiscard]] VariantSummary summary_of(const VariantBench& bench);

/// The runs of each planner on all variants, merged as if on one problem.
[[nodiscard]] std::vector<PlanBench> merged_plans(const VariantBench& bench);

/// The seeds that a planner did not solve.
[[nodiscard]] std::vector<std::uint64_t> unsolved_seeds(const PlanBench& bench);

}  // namespace handway::tools
