#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "model/document/document.h"
#include "model/playback/path_timeline.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <memory>

namespace handway::gui {

/// Plays a path, forwards or backwards.
class PathPlayer : public QObject {
  Q_OBJECT

 public:
  /// Time for which a frame is shown, s at real time.
  static constexpr double kFrame = 1.0 / 30.0;

  explicit PathPlayer(QObject* parent = nullptr);

  /// @param made_from of the scene that the path was found or checked in.
  void set_timeline(PathTimeline timeline, const planning::Revision& made_from = {});
  void clear() { set_timeline({}); }
  /// The path was checked in another scene, and is valid there, too.
  void confirm(const planning::Revision& made_from) { made_from_ = made_from; }
  [[nodiscard]] const planning::Revision& made_from() const { return made_from_; }
  /// The path has got times: it goes on from where it is. @pre `motion` is one of the path.
  void set_motion(std::shared_ptr<const planning::Motion> motion);
  /// Meaning of duration() and time(): whether they are those of a robot that follows the path.
  enum class Times {
    kPending,    ///< They are being found: those before were of another scene or path.
    kKnown,      ///< The times of the motion.
    kEstimated,  ///< There is no motion; the path is played at even speed.
  };
  [[nodiscard]] Times times() const { return times_; }
  /// @param times not kKnown, which set_motion() makes.
  void set_times(Times times);
  [[nodiscard]] const PathTimeline& timeline() const { return timeline_; }

  [[nodiscard]] double fraction() const { return fraction_; }
  /// Returns whether the robot is shown at fraction() of the path; false if it was moved
  /// otherwise.
  [[nodiscard]] bool is_at_robot() const { return is_at_robot_; }
  /// The robot is shown in `q`: at the start or the end of the path, fraction() becomes that.
  void locate(const geometric::Configuration& q);
  [[nodiscard]] bool is_playing() const { return timer_.isActive(); }
  /// Returns the duration of the whole path at speed 1, s.
  [[nodiscard]] double duration() const { return timeline_.duration(); }
  [[nodiscard]] double time() const { return fraction_ * duration(); }

  void play();
  void pause();
  void seek(double fraction);
  /// Steps to the next waypoint, or the one before.
  void step_forward() { seek(timeline_.next_waypoint(fraction_)); }
  void step_back() { seek(timeline_.previous_waypoint(fraction_)); }
  /// Steps by frames, as if it played at real time. @param frames below 0: back.
  void step_frames(int frames);
  /// @param factor times real time, above 0.
  void set_speed(double factor) { speed_ = factor; }
  void set_loop(bool on) { loop_ = on; }
  void set_backwards(bool on) { backwards_ = on; }

 signals:
  void moved(double fraction);
  void playing_changed(bool playing);
  void timeline_changed();
  /// Emitted when the path is the same, with other times.
  void retimed();
  /// The robot was moved by something else, see locate().
  void located();

 private:
  void advance();
  /// Returns the fractions of the beginning and the end; they are swapped for backward playback.
  [[nodiscard]] double begin() const { return backwards_ ? 1.0 : 0.0; }
  [[nodiscard]] double end() const { return backwards_ ? 0.0 : 1.0; }

  PathTimeline timeline_;
  planning::Revision made_from_;
  QTimer timer_;
  QElapsedTimer clock_;
  double fraction_ = 0.0;
  bool is_at_robot_ = true;
  Times times_ = Times::kPending;
  double speed_ = 1.0;
  double rest_s_ = 0.0;  ///< Still to wait at the end before a loop starts again.
  bool loop_ = true;
  bool backwards_ = false;
};

/// Moves the document's robot by hand, which pauses a path that is played.
class Posing : public QObject {
 public:
  /// The document and the player outlive it.
  Posing(Document& document, PathPlayer& player, QObject* parent = nullptr)
      : QObject(parent), document_(document), player_(player) {}

  void set(const Eigen::VectorXd& q) {
    player_.pause();
    document_.set_configuration(q);
  }
  void apply(const geometric::NamedPosture& posture) {
    player_.pause();
    document_.apply_posture(posture);
  }

 private:
  Document& document_;
  PathPlayer& player_;
};

}  // namespace handway::gui
