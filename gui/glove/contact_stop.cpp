#include "glove/contact_stop.h"

#include <utility>

namespace handway::gui {

ContactStop::ContactStop(QObject* parent) : QObject(parent) {
  connect(&monitor_, &CollisionMonitor::checked, this, &ContactStop::take);
  connect(&monitor_, &CollisionMonitor::failed, this, [this](const QString& message) {
    checked_.reset();
    waiting_.reset();
    holds_ = true;
    emit held(message);
  });
}

void ContactStop::set_problem(std::shared_ptr<const PreparedProblem> problem) {
  problem_ = problem;
  monitor_.set_problem(std::move(problem));
  checked_.reset();
  waiting_.reset();
}

void ContactStop::set_on(bool on) {
  on_ = on;
  waiting_.reset();
  if (!on && std::exchange(holds_, false)) {
    emit held({});
  }
}

void ContactStop::propose(const geometric::NamedPosture& posture,
                          const geometric::Configuration& q) {
  if (!on_ || !problem_) {
    emit passed(posture);
  } else if (checked_) {
    waiting_ = Proposal{posture, q};
  } else {
    check({posture, q});
  }
}

void ContactStop::check(Proposal proposal) {
  monitor_.check(proposal.q);
  checked_ = std::move(proposal);
}

void ContactStop::take(const CollisionReport& report) {
  const std::optional<Proposal> answered = std::exchange(checked_, std::nullopt);
  if (!on_ || !answered) {
    return;
  }
  if (waiting_) {
    check(*std::exchange(waiting_, std::nullopt));
  }
  if (report.collisions.empty()) {
    if (std::exchange(holds_, false)) {
      emit held({});
    }
    emit passed(answered->posture);
  } else {
    holds_ = true;
    emit held(tr("%1 touches %2")
                  .arg(QString::fromStdString(report.collisions.front().a),
                       QString::fromStdString(report.collisions.front().b)));
  }
}

}  // namespace handway::gui
