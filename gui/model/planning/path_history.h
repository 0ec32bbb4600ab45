#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/human_likeness.h"
#include "model/playback/motion_analysis.h"

#include <QObject>
#include <QString>
#include <QTime>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace handway::geometric {
class RobotModel;
}  // namespace handway::geometric
namespace handway::planning {
struct Path;
}  // namespace handway::planning

namespace handway::gui {

struct PathRecord;

/// A run of a planner: all that it takes to do it again, and what came of it.
struct PlanRun {
  int number = 0;  ///< From 1, in the order in which runs began.
  QTime begun;
  planning::SceneState state;         ///< Robots, objects, start and goal.
  geometric::PlannerRequest planner;  ///< With the settings that are not its own values.
  QString preset;                     ///< In words.
  planning::PlanRequest request;
  planning::PlanResult result;
  QString failure;  ///< Reason of a failure; empty if there is a result.
};

/// Returns the outcome of planning in few words: "Path found".
[[nodiscard]] QString status_text(planning::PlanStatus status);
/// A result as one line of plain text.
[[nodiscard]] QString result_line(const planning::PlanResult& result);

/// "350 ms", "2.41 s".
[[nodiscard]] QString seconds_text(double seconds);
/// Returns the count with commas between thousands.
[[nodiscard]] QString count_text(std::uint64_t count);

/// The key figures of a path.
struct PathFigures {
  double duration = 0.0;     ///< s
  double length = 0.0;       ///< In joints normalised to [0, 1].
  double turning = 0.0;      ///< See turning_of().
  double palm_travel = 0.0;  ///< m
  int waypoints = 0;
  double least_clearance = 0.0;  ///< m, at most kMostClearance; or a run's certificate.
  /// m, over time, more than kMostClearance counting as that; nothing where it was not looked at.
  std::optional<double> mean_clearance;
  /// Human-likeness of the hand over time; nothing if there is nothing to compare with.
  std::optional<planning::DistanceAlong> to_subspace;
  std::optional<planning::DistanceAlong> to_recorded;
};

/// @pre the record has a motion with its curves; if those have no clearance, it has a run.
[[nodiscard]] PathFigures figures_of(const PathRecord& record);

/// Returns whether two paths have the same waypoints, to the bit.
[[nodiscard]] bool same_path(const planning::Path& a, const planning::Path& b);

/// Returns the length of the path in joints normalised to [0, 1].
[[nodiscard]] double length_of(const geometric::RobotModel& model, const planning::Path& path);

/// Returns by how much a path changes its direction at all its waypoints together, rad, in joints
/// normalised to [0, 1]: 0 for a straight one.
[[nodiscard]] double turning_of(const geometric::RobotModel& model, const planning::Path& path);

/// Criterion to choose the better of two paths.
enum class PathMerit { kShort, kQuick, kSmooth, kHuman, kClear };
inline constexpr std::array kPathMerits{PathMerit::kShort, PathMerit::kQuick, PathMerit::kSmooth,
                                        PathMerit::kHuman, PathMerit::kClear};

/// Returns the cost of a path; the path with the lower cost is better.
[[nodiscard]] double cost(const PathFigures& figures, PathMerit merit);

/// The best by that merit: "shortest", "quickest", …
[[nodiscard]] QString superlative(PathMerit merit);

/// A path that was found or shown, or a run that found none, with all that is known about it.
struct PathRecord {
  QString label;
  std::shared_ptr<const geometric::Scene> scene;
  int palm = 0;                                    ///< Link whose way is measured.
  std::shared_ptr<const planning::Motion> motion;  ///< Null: no path, or not timed yet.
  std::shared_ptr<const MotionCurves> curves;      ///< Null: there is no motion, or not found yet.
  std::shared_ptr<const PlanRun> run;  ///< Null: from a file, or a path that follows edits.
  std::optional<PathFigures> figures;  ///< Once there are curves.
  int opened_scene = 0;                ///< Counts the scenes of a session.
  QString remark = {};                 ///< Remark about a file, a sentence.

  [[nodiscard]] bool has_figures() const { return figures.has_value(); }
  /// Returns whether its run has found a path.
  [[nodiscard]] bool is_solved() const { return run && run->result.solved(); }
};

/// The best of those that found a path; of those as good the one with the least seed, whichever
/// was done first. Paths without figures come last. The end if there is none.
[[nodiscard]] std::vector<PathRecord>::const_iterator best_of(
    const std::vector<PathRecord>& records, PathMerit merit);

/// Returns the displayed name of a path. @param origin source of the path: "auto, seed 1".
[[nodiscard]] QString label_of(const QString& origin, const planning::Motion& motion,
                               const QTime& time);
/// Returns the displayed name of a path that a planner found.
[[nodiscard]] QString label_of(const PlanRun& run, const planning::Motion& motion);

/// The paths and runs of the scene that is open and of some that were open before, the latest
/// first. They keep their scenes, with all meshes.
class PathHistory : public QObject {
  Q_OBJECT

 public:
  static constexpr std::size_t kMost = 200;
  static constexpr int kEarlierScenes = 2;  ///< To compare paths with.

  explicit PathHistory(QObject* parent = nullptr) : QObject(parent) {}

  /// One of a motion that is there already brings new curves to that; one of a path that a run
  /// found in the same scene is that run's.
  /// @returns the motion that the record goes by now; null if it has none.
  std::shared_ptr<const planning::Motion> add(PathRecord record);
  /// Begins the records of another scene.
  void begin_scene();
  [[nodiscard]] const std::vector<PathRecord>& records() const { return records_; }
  [[nodiscard]] bool is_of_open_scene(const PathRecord& record) const {
    return record.opened_scene == opened_scene_;
  }
  /// Returns the records with a motion and its curves.
  [[nodiscard]] std::vector<PathRecord> paths() const;

 signals:
  void changed();

 private:
  std::vector<PathRecord> records_;
  int opened_scene_ = 0;
};

}  // namespace handway::gui
