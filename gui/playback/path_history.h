#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/queries/human_likeness.h"
#include "workers/motion_curves.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// A path that was shown, with all that is known about it.
struct PathRecord {
  QString label;
  std::shared_ptr<const geometric::Scene> scene;
  int palm = 0;  ///< Link whose way is measured.
  std::shared_ptr<const planning::Motion> motion;
  std::shared_ptr<const MotionCurves> curves;
};

/// The key figures of a path.
struct PathFigures {
  double duration = 0.0;  ///< s
  double length = 0.0;    ///< In joints normalised to [0, 1].
  double palm_way = 0.0;  ///< m
  int waypoints = 0;
  double least_clearance = 0.0;  ///< m, at most kMostClearance.
  double mean_clearance = 0.0;   ///< m, over time, more than kMostClearance counting as that.
  /// How human the hand looks, over time; nothing where there is nothing to compare with.
  std::optional<planning::DistanceAlong> to_subspace;
  std::optional<planning::DistanceAlong> to_recorded;
};

[[nodiscard]] PathFigures figures_of(const PathRecord& record);

/// The paths of a session, the latest first.
class PathHistory : public QObject {
  Q_OBJECT

 public:
  static constexpr std::size_t kMost = 30;

  explicit PathHistory(QObject* parent = nullptr) : QObject(parent) {}

  /// One of a motion that is there already brings new curves to that.
  void add(PathRecord record);
  [[nodiscard]] const std::vector<PathRecord>& records() const { return records_; }

 signals:
  void changed();

 private:
  std::vector<PathRecord> records_;
};

}  // namespace handway::gui
