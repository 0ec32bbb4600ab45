#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "workers/collision_monitor.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>

namespace handway::gui {

/// Lets postures through only if nothing collides in them: a hand that follows a glove stops
/// at contact, in its last free posture. Checks aside, one posture at a time; of those
/// that come meanwhile only the latest counts.
class ContactStop : public QObject {
  Q_OBJECT

 public:
  explicit ContactStop(QObject* parent = nullptr);

  /// Null: nothing to collide with.
  void set_problem(std::shared_ptr<const PreparedProblem> problem);
  /// While it is off all postures pass at once.
  void set_on(bool on);
  [[nodiscard]] bool is_on() const { return on_; }

  /// @param q of the first robot with that posture, shape [variable_count].
  void propose(const geometric::NamedPosture& posture, const geometric::Configuration& q);

 signals:
  void passed(const handway::geometric::NamedPosture& posture);
  /// The hand is held, by what; empty: it moves again.
  void held(const QString& contact);

 private:
  struct Proposal {
    geometric::NamedPosture posture;
    geometric::Configuration q;
  };

  void check(Proposal proposal);
  void take(const CollisionReport& report);

  CollisionMonitor monitor_;
  std::shared_ptr<const PreparedProblem> problem_;
  std::optional<Proposal> checked_;  ///< Asked about, no answer yet.
  std::optional<Proposal> waiting_;
  bool on_ = false;
  bool holds_ = false;
};

}  // namespace handway::gui
