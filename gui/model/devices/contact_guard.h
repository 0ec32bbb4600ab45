#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/robot/joint_selection.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// Reaction to a step that leads into a collision.
enum class ContactRule {
  kPass,   ///< It is made.
  kStop,   ///< The step is not made.
  kSlide,  ///< The free part is made: see geometric::sliding_step().
};

/// Merges all postures with which devices lead the robot, and passes on what its rule permits: all
/// of a step, or only its free part. Steps are checked in the background; steps that come
/// faster than they can be checked are skipped.
class ContactGuard : public QObject {
  Q_OBJECT

 public:
  /// A device, by the part of the robot that it leads.
  enum class Leader { kHand, kArm };

  explicit ContactGuard(QObject* parent = nullptr);

  /// @param model null: no robot.
  /// @param groups variables that go together, such as arm and fingers.
  /// @param problem null: nothing to collide with.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model,
                 std::vector<geometric::JointIndices> groups,
                 std::shared_ptr<const PreparedProblem> problem);
  void set_rule(ContactRule rule);
  [[nodiscard]] ContactRule rule() const { return rule_; }
  /// Sets the configuration of the robot. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q) { q_ = q; }

  /// The leader wants its joints there, until it wants something else or withdraws.
  void propose(Leader leader, const geometric::NamedPosture& posture);
  void withdraw(Leader leader);

 signals:
  void passed(const handway::geometric::NamedPosture& posture);
  /// The robot is kept from where it is led, by what; empty: it follows again.
  void held(const QString& contact);

 private:
  /// A step may be made as far as `q`. @param contact what touches beyond; nothing if all is free.
  void take(const geometric::Configuration& q, const std::optional<geometric::NamedPair>& contact);
  void notify(const QString& contact);
  [[nodiscard]] geometric::NamedPosture wanted() const;

  std::shared_ptr<const geometric::RobotModel> model_;
  std::vector<geometric::JointIndices> groups_;  ///< For geometric::sliding_step().
  std::shared_ptr<OwnChecker> checker_;          ///< For the job; null: all is free.
  ContactRule rule_ = ContactRule::kPass;
  geometric::Configuration q_;
  std::array<geometric::NamedPosture, 2> wanted_;  ///< By Leader.
  bool holds_ = false;
  LatestJob job_;
};

}  // namespace handway::gui
