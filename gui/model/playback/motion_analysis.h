#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/exporter.h"
#include "handway/sampling/postures/posture_table.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

class Document;
class PathPlayer;

/// A path with times, or why it can't have any.
struct PathMotion {
  std::shared_ptr<const planning::Motion> motion;  ///< Null if there is a fault.
  std::string fault;                               ///< A sentence.
};

/// The path as a robot goes it that is as fast as its joints allow, with arcs where they are free.
/// @throws geometric::InputError for waypoints that are no configurations of the robot.
[[nodiscard]] PathMotion motion_of(const planning::PlanningProblem& problem,
                                   const planning::Path& path);

/// Curves along the points of a motion beside the joints; all of shape [points].
struct MotionCurves {
  /// m, at most kMostClearance; empty, as `closest` is, where only hands are looked at.
  std::vector<double> clearance;
  std::vector<std::string> closest;  ///< "A with B", empty where nothing is near.
  /// Human-likeness of the hand, see planning::HandLikeness; empty: nothing to compare with.
  std::vector<double> to_subspace;
  std::vector<double> to_recorded;
};

/// Limit of clearance, m; more is not distinguished.
inline constexpr double kMostClearance = 0.1;

/// @param postures of a person, may be null.
/// @param stop ends it early; what it returns then is of no use.
[[nodiscard]] MotionCurves motion_curves(
    const planning::PlanningProblem& problem,
    const std::shared_ptr<const sampling::RecordedPostures>& postures,
    const planning::Trajectory& trajectory, const std::stop_token& stop);

/// Returns the curves without clearance, which takes nearly all of the time.
[[nodiscard]] MotionCurves hand_curves(
    const planning::PlanningProblem& problem,
    const std::shared_ptr<const sampling::RecordedPostures>& postures,
    const planning::Trajectory& trajectory, const std::stop_token& stop);

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

  /// The document and the player outlive it.
  MotionAnalysis(Document& document, PathPlayer& player, QObject* parent = nullptr);

  [[nodiscard]] State state() const { return state_; }
  /// Returns the motion; null unless the state is kTimed.
  [[nodiscard]] const std::shared_ptr<const planning::Motion>& motion() const { return motion_; }
  /// Returns the curves; null until they are computed.
  [[nodiscard]] const std::shared_ptr<const MotionCurves>& curves() const { return curves_; }
  /// Returns the reason why there are no times.
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
  std::shared_ptr<const planning::PlanningProblem> problem_;  ///< Problem of motion_.
  QString fault_;
  QTimer calm_;  ///< Paths that follow each other fast are not timed.
  LatestJob job_;
};

}  // namespace handway::gui
