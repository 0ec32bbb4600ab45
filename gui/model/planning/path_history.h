#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/planning/path_figures.h"
#include "model/planning/plan_run.h"
#include "model/playback/motion_curves.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// A path that was found or shown, or a run that found none, with all that is known about it.
struct PathRecord {
  QString label;
  std::shared_ptr<const geometric::Scene> scene;
  int palm = 0;                                    ///< Link whose way is measured.
  std::shared_ptr<const planning::Motion> motion;  ///< Null: no path, or not timed yet.
  std::shared_ptr<const MotionCurves> curves;      ///< Null: there is no motion, or not found yet.
  std::shared_ptr<const PlanRun> run;  ///< Null: from a file, or a path that follows edits.
  std::optional<PathFigures> figures;  ///< Once there are curves.

  [[nodiscard]] bool has_figures() const { return figures.has_value(); }
  /// Has its run found a path?
  [[nodiscard]] bool is_solved() const { return run && run->result.solved(); }
};

/// The best of those that found a path; of those as good the one with the least seed, whichever
/// was done first. Paths without figures come last. The end if there is none.
[[nodiscard]] std::vector<PathRecord>::const_iterator best_of(
    const std::vector<PathRecord>& records, PathMerit merit);

/// What a person calls a path. @param way where it comes from: "auto, seed 1".
[[nodiscard]] QString label_of(const QString& way, const planning::Motion& motion,
                               const QTime& time);
/// The same of one that a planner found.
[[nodiscard]] QString label_of(const PlanRun& run, const planning::Motion& motion);

/// The paths and runs of a session, the latest first.
class PathHistory : public QObject {
  Q_OBJECT

 public:
  static constexpr std::size_t kMost = 200;

  explicit PathHistory(QObject* parent = nullptr) : QObject(parent) {}

  /// One of a motion that is there already brings new curves to that; one of a path that a run
  /// found in the same scene is that run's.
  /// @returns the motion that the record goes by now; null if it has none.
  std::shared_ptr<const planning::Motion> add(PathRecord record);
  [[nodiscard]] const std::vector<PathRecord>& records() const { return records_; }
  /// Those with a motion and its curves.
  [[nodiscard]] std::vector<PathRecord> paths() const;

 signals:
  void changed();

 private:
  std::vector<PathRecord> records_;
};

}  // namespace handway::gui
