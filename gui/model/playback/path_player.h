#pragma once

#include "handway/planning/core/revision.h"
#include "model/playback/path_timeline.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace handway::gui {

/// Plays a path, forwards or backwards.
class PathPlayer : public QObject {
  Q_OBJECT

 public:
  /// How long a picture is shown, s at real time.
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
  [[nodiscard]] const PathTimeline& timeline() const { return timeline_; }

  [[nodiscard]] double fraction() const { return fraction_; }
  [[nodiscard]] bool is_playing() const { return timer_.isActive(); }
  /// How long the whole path takes at speed 1, s.
  [[nodiscard]] double duration() const { return timeline_.duration(); }
  [[nodiscard]] double time() const { return fraction_ * duration(); }

  void play();
  void pause();
  void seek(double fraction);
  /// To the next waypoint, or the one before.
  void step_forward() { seek(timeline_.next_waypoint(fraction_)); }
  void step_back() { seek(timeline_.previous_waypoint(fraction_)); }
  /// By pictures, as if it played at real time. @param frames below 0: back.
  void step_frames(int frames);
  /// @param factor times real time, above 0.
  void set_speed(double factor) { speed_ = factor; }
  void set_loop(bool on) { loop_ = on; }
  void set_backwards(bool on) { backwards_ = on; }

 signals:
  void moved(double fraction);
  void playing_changed(bool playing);
  void timeline_changed();
  /// The same path, with other times.
  void retimed();

 private:
  void advance();
  /// Where it begins, and where it ends; they change places when it plays backwards.
  [[nodiscard]] double begin() const { return backwards_ ? 1.0 : 0.0; }
  [[nodiscard]] double end() const { return backwards_ ? 0.0 : 1.0; }

  PathTimeline timeline_;
  planning::Revision made_from_;
  QTimer timer_;
  QElapsedTimer clock_;
  double fraction_ = 0.0;
  double speed_ = 1.0;
  double rest_s_ = 0.0;  ///< Still to wait at the end before a loop starts again.
  bool loop_ = true;
  bool backwards_ = false;
};

}  // namespace handway::gui
