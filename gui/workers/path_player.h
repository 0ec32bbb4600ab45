#pragma once

#include "workers/path_timeline.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace handway::gui {

/// Plays a path in real time.
class PathPlayer : public QObject {
  Q_OBJECT

 public:
  /// Normalised joint distance per second at speed 1.
  static constexpr double kRate = 0.35;

  explicit PathPlayer(QObject* parent = nullptr);

  void set_timeline(PathTimeline timeline);
  void clear() { set_timeline({}); }
  [[nodiscard]] const PathTimeline& timeline() const { return timeline_; }

  [[nodiscard]] double fraction() const { return fraction_; }
  [[nodiscard]] bool is_playing() const { return timer_.isActive(); }
  /// How long the whole path takes at the present speed, s.
  [[nodiscard]] double duration() const;

  void play();
  void pause();
  void seek(double fraction);
  void step_forward() { seek(timeline_.next_waypoint(fraction_)); }
  void step_back() { seek(timeline_.previous_waypoint(fraction_)); }
  void set_speed(double factor);
  void set_loop(bool on) { loop_ = on; }

 signals:
  void moved(double fraction);
  void playing_changed(bool playing);
  void timeline_changed();

 private:
  void advance();

  PathTimeline timeline_;
  QTimer timer_;
  QElapsedTimer clock_;
  double fraction_ = 0.0;
  double speed_ = 1.0;
  double rest_s_ = 0.0;  ///< Still to wait at the end before a loop begins anew.
  bool loop_ = true;
};

}  // namespace handway::gui
