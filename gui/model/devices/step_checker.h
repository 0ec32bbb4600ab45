#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "model/document/prepared_problem.h"

#include <QObject>

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

}  // namespace handway::gui
