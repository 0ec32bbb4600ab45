#include "model/devices/step_checker.h"

#include "handway/geometric/collision/sliding_step.h"

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

}  // namespace handway::gui
