#pragma once

#include "handway/planning/queries/human_likeness.h"

#include <QString>

#include <array>
#include <optional>

namespace handway::planning {
struct Path;
}
namespace handway::geometric {
class RobotModel;
}

namespace handway::gui {

struct PathRecord;

/// The key figures of a path.
struct PathFigures {
  double duration = 0.0;  ///< s
  double length = 0.0;    ///< In joints normalised to [0, 1].
  double turning = 0.0;   ///< See turning_of().
  double palm_way = 0.0;  ///< m
  int waypoints = 0;
  double least_clearance = 0.0;  ///< m, at most kMostClearance; or a run's certificate.
  /// m, over time, more than kMostClearance counting as that; nothing where it was not looked at.
  std::optional<double> mean_clearance;
  /// How human the hand looks, over time; nothing where there is nothing to compare with.
  std::optional<planning::DistanceAlong> to_subspace;
  std::optional<planning::DistanceAlong> to_recorded;
};

/// @pre the record has a motion with its curves; if those have no clearance, it has a run.
[[nodiscard]] PathFigures figures_of(const PathRecord& record);

/// In joints normalised to [0, 1].
[[nodiscard]] double length_of(const geometric::RobotModel& model, const planning::Path& path);

/// By how much a path changes its direction at all its waypoints together, rad, in joints
/// normalised to [0, 1]: 0 for a straight one.
[[nodiscard]] double turning_of(const geometric::RobotModel& model, const planning::Path& path);

/// By what the better of two paths is told.
enum class PathMerit { kShort, kQuick, kSmooth, kHuman, kClear };
inline constexpr std::array kPathMerits{PathMerit::kShort, PathMerit::kQuick, PathMerit::kSmooth,
                                        PathMerit::kHuman, PathMerit::kClear};

/// Of two paths, the one with the lesser cost is better.
[[nodiscard]] double cost(const PathFigures& figures, PathMerit merit);

/// The best by that merit: "shortest", "quickest", …
[[nodiscard]] QString superlative(PathMerit merit);

}  // namespace handway::gui
