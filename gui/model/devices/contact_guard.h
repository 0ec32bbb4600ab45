#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/robot/robot_description.h"
#include "model/document/prepared_problem.h"

#include <QObject>
#include <QString>

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace handway::gui {

/// What becomes of a step that leads into something.
enum class ContactRule {
  kPass,   ///< It is made.
  kStop,   ///< None of it is made.
  kSlide,  ///< Made as far as it is free: see geometric::sliding_step().
};

/// A step of the first robot; both shape [variable_count].
struct ProposedStep {
  geometric::Configuration from;
  geometric::Configuration to;
  ContactRule rule = ContactRule::kStop;
};

struct StepReport {
  geometric::Configuration q;                   ///< As far as the step may go.
  std::optional<geometric::NamedPair> contact;  ///< What touches beyond; nothing if all is free.
};

/// Finds out, on a thread of its own, how far steps may go. Only the latest step
/// counts: those that come faster than they can be checked are skipped.
class StepChecker : public QObject {
  Q_OBJECT

 public:
  explicit StepChecker(QObject* parent = nullptr);
  ~StepChecker() override;

  /// @param problem null: everything is free. @param groups for geometric::sliding_step().
  void set_problem(std::shared_ptr<const PreparedProblem> problem,
                   std::vector<std::vector<int>> groups);
  void check(const ProposedStep& step);

 signals:
  void checked(const handway::gui::StepReport& report);
  void failed(const QString& message);

 private:
  struct Setup {
    std::shared_ptr<const PreparedProblem> problem;
    std::vector<std::vector<int>> groups;
  };

  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::shared_ptr<const Setup> setup_ = std::make_shared<Setup>();
  std::optional<ProposedStep> next_;
  std::jthread thread_;
};

/// Through whose hands all postures go by which devices lead the robot. It merges them, and lets
/// through what its rule says: all of it, or only what is free.
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
                 std::vector<std::vector<int>> groups,
                 std::shared_ptr<const PreparedProblem> problem);
  void set_rule(ContactRule rule);
  [[nodiscard]] ContactRule rule() const { return rule_; }
  /// Where the robot is. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q) { q_ = q; }

  /// The leader wants its joints there, until it wants something else or withdraws.
  void propose(Leader leader, const geometric::NamedPosture& posture);
  void withdraw(Leader leader);

 signals:
  void passed(const handway::geometric::NamedPosture& posture);
  /// The robot is kept from where it is led, by what; empty: it follows again.
  void held(const QString& contact);

 private:
  void take(const StepReport& report);
  void tell(const QString& contact);
  [[nodiscard]] geometric::NamedPosture wanted() const;

  StepChecker checker_;
  std::shared_ptr<const geometric::RobotModel> model_;
  bool has_problem_ = false;
  ContactRule rule_ = ContactRule::kPass;
  geometric::Configuration q_;
  std::array<geometric::NamedPosture, 2> wanted_;  ///< By Leader.
  bool holds_ = false;
};

}  // namespace handway::gui
