#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/human_likeness.h"
#include "handway/planning/queries/motion_likeness.h"
#include "handway/sampling/postures/posture_table.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace handway::tools {

/// Measures of the timed motion along a path.
struct MotionMeasures {
  planning::MotionLikeness likeness;
  std::string fault;       ///< Reason why the path can't be timed, a sentence; then no measures.
  std::string recordings;  ///< Source of the recorded motions; may be empty.
  Eigen::MatrixXd motion;  ///< planning::comparable_motion(); empty with a fault.
};

/// The JSON report of a run, keys as in docs/command-line.md.
/// @param likeness of the path's hand; nothing without a path or a basis to compare with.
/// @param quality of the path; nothing without a path. @param motion nothing without a path.
[[nodiscard]] std::string plan_report(planning::Planner& planner,
                                      const planning::PlanningProblem& problem,
                                      const planning::PlanRequest& request,
                                      const planning::PlanResult& result, double load_s,
                                      const std::optional<planning::PathLikeness>& likeness,
                                      const std::optional<planning::PathQuality>& quality,
                                      const std::optional<MotionMeasures>& motion);

/// Quality measures of a path, keys as `objective` in docs/command-line.md; null without a path.
[[nodiscard]] nlohmann::ordered_json path_quality_json(
    const std::optional<planning::PathQuality>& quality);

/// Measures of a timed motion, keys as `motion` in docs/command-line.md; null without measures.
[[nodiscard]] nlohmann::ordered_json motion_json(const std::optional<MotionMeasures>& motion);

/// Recorded postures of the problem's hand; null without a basis or postures.
/// @param postures file to read; empty: those that the basis names, if any.
/// @throws InputError if the postures can't be read, or a file is given and there's no basis.
[[nodiscard]] std::shared_ptr<const sampling::RecordedPostures> recorded_postures(
    const planning::PlanningProblem& problem, const std::filesystem::path& postures = {});

/// Likeness of the hand along a path to a human hand; nothing without a basis or a path.
/// @param recorded may be null.
[[nodiscard]] std::optional<planning::PathLikeness> hand_likeness(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::shared_ptr<const sampling::RecordedPostures>& recorded);

/// Times a path and measures its motion; nothing without a path.
/// @param recorded may be null.
[[nodiscard]] std::optional<MotionMeasures> measure_motion(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::shared_ptr<const sampling::RecordedPostures>& recorded);

}  // namespace handway::tools
