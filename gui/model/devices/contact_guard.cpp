#include "model/devices/contact_guard.h"

#include "handway/geometric/collision/continuous/sliding_step.h"
#include "handway/geometric/robot/composed_robot.h"

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

using geometric::CollisionChecker;
using geometric::FreeStep;

StepReport report_on(CollisionChecker& checker, const ProposedStep& step,
                     const std::vector<std::vector<int>>& groups) {
  const bool slides = step.rule == ContactRule::kSlide;
  const FreeStep free = slides ? sliding_step(checker, step.from, step.to, groups)
                               : straight_step(checker, step.from, step.to);
  if (!free.pair) {
    return {step.to, std::nullopt};
  }
  return {slides ? free.q : step.from, named_pair(checker.world(), *free.pair, 0.0)};
}

}  // namespace

StepChecker::StepChecker(QObject* parent)
    : QObject(parent), thread_([this](const std::stop_token& stop) { work(stop); }) {}

StepChecker::~StepChecker() {
  thread_.request_stop();
  wake_.notify_all();
}

void StepChecker::set_problem(std::shared_ptr<const PreparedProblem> problem,
                              std::vector<std::vector<int>> groups) {
  const std::lock_guard lock(mutex_);
  setup_ = std::make_shared<Setup>(Setup{std::move(problem), std::move(groups)});
  next_.reset();
}

void StepChecker::check(const ProposedStep& step) {
  {
    const std::lock_guard lock(mutex_);
    next_ = step;
  }
  wake_.notify_all();
}

void StepChecker::work(const std::stop_token& stop) {
  std::shared_ptr<const Setup> setup;
  std::unique_ptr<CollisionChecker> checker;
  while (true) {
    ProposedStep step;
    bool is_new = false;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return next_.has_value(); })) {
        return;
      }
      step = *std::exchange(next_, std::nullopt);
      is_new = setup != setup_;
      setup = setup_;
    }
    const auto deliver = [this, setup](auto tell) {
      QMetaObject::invokeMethod(
          this,
          [this, setup, tell = std::move(tell)] {
            if (setup == setup_) {
              tell();
            }
          },
          Qt::QueuedConnection);
    };
    try {
      if (is_new) {
        checker.reset();
        if (setup->problem) {
          const PreparedProblem::Problem prepared = setup->problem->wait(stop);
          if (!prepared) {
            return;
          }
          checker = prepared->checker->clone();
        }
      }
      StepReport report =
          checker ? report_on(*checker, step, setup->groups) : StepReport{step.to, std::nullopt};
      deliver([this, report = std::move(report)] { emit checked(report); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  }
}

using geometric::NamedPosture;

ContactGuard::ContactGuard(QObject* parent) : QObject(parent) {
  connect(&checker_, &StepChecker::checked, this, &ContactGuard::take);
  connect(&checker_, &StepChecker::failed, this, &ContactGuard::tell);
}

void ContactGuard::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                             std::vector<std::vector<int>> groups,
                             std::shared_ptr<const PreparedProblem> problem) {
  model_ = std::move(model);
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  wanted_ = {};
  has_problem_ = problem != nullptr;
  checker_.set_problem(std::move(problem), std::move(groups));
  tell({});
}

void ContactGuard::set_rule(ContactRule rule) {
  rule_ = rule;
  if (rule == ContactRule::kPass) {
    tell({});
  }
}

NamedPosture ContactGuard::wanted() const {
  NamedPosture all;
  for (const NamedPosture& posture : wanted_) {
    all.values.insert(posture.values.begin(), posture.values.end());
  }
  return all;
}

void ContactGuard::propose(Leader leader, const NamedPosture& posture) {
  if (!model_) {
    return;
  }
  wanted_.at(static_cast<std::size_t>(leader)) = posture;
  if (rule_ == ContactRule::kPass || !has_problem_) {
    emit passed(posture);
    return;
  }
  geometric::Configuration to = q_;
  for (const auto& [joint, value] : wanted().values) {
    if (const auto variable = geometric::find_variable_of_part(*model_, joint)) {
      to[*variable] = value;
    }
  }
  checker_.check({q_, to, rule_});
}

void ContactGuard::withdraw(Leader leader) {
  wanted_.at(static_cast<std::size_t>(leader)).values.clear();
  if (wanted().values.empty()) {
    tell({});
  }
}

void ContactGuard::take(const StepReport& report) {
  NamedPosture posture = wanted();
  if (rule_ == ContactRule::kPass || posture.values.empty()) {
    return;
  }
  const auto text = [](const geometric::NamedPair& contact) {
    const QString a = QString::fromStdString(contact.a);
    return contact.b.empty() ? tr("At the limit of constraint %1").arg(a)
                             : tr("%1 touches %2").arg(a, QString::fromStdString(contact.b));
  };
  tell(report.contact ? text(*report.contact) : QString());
  for (auto& [joint, value] : posture.values) {
    if (const auto variable = geometric::find_variable_of_part(*model_, joint)) {
      value = report.q[*variable];
    }
  }
  emit passed(posture);
}

void ContactGuard::tell(const QString& contact) {
  if (holds_ || !contact.isEmpty()) {
    holds_ = !contact.isEmpty();
    emit held(contact);
  }
}

}  // namespace handway::gui
