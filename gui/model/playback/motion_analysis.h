#pragma once

#include "model/jobs/latest_job.h"
#include "model/playback/motion_curves.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>

namespace handway::gui {

class Document;
class PathPlayer;

/// Times the player's path in the background, gives the times to the player, and then finds out
/// what else can be drawn over them.
class MotionAnalysis : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kNoPath,
    kTiming,
    kTimed,  ///< There is a motion; its curves may be still to come.
    kFailed,
  };

  /// Both outlive it.
  MotionAnalysis(Document& document, PathPlayer& player, QObject* parent = nullptr);

  [[nodiscard]] State state() const { return state_; }
  /// Null unless the state is kTimed.
  [[nodiscard]] const std::shared_ptr<const planning::Motion>& motion() const { return motion_; }
  /// Null until they are there.
  [[nodiscard]] const std::shared_ptr<const MotionCurves>& curves() const { return curves_; }
  /// Why there are no times.
  [[nodiscard]] const QString& fault() const { return fault_; }

 signals:
  void changed();

 private:
  void begin();
  void time_path();
  void take_motion(const PathMotion& timed);
  void find_curves();

  Document& document_;
  PathPlayer& player_;
  State state_ = State::kNoPath;
  std::shared_ptr<const planning::Motion> motion_;
  std::shared_ptr<const MotionCurves> curves_;
  std::shared_ptr<const planning::PlanningProblem> problem_;  ///< That motion_ is of.
  QString fault_;
  QTimer calm_;  ///< Paths that follow each other fast are not timed.
  LatestJob job_;
};

}  // namespace handway::gui
