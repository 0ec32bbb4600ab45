#include "model/document/collision_monitor.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {
namespace {

using geometric::CollisionChecker;
using geometric::Configuration;

CollisionReport report_on(CollisionChecker& checker, geometric::ClosestPointFinder& finder,
                          const Configuration& q) {
  CollisionReport report;
  report.collisions = geometric::find_collisions(checker, q);
  report.violated = geometric::violated_constraints(checker, q);
  if (report.collisions.empty()) {
    const geometric::NamedPair pair =
        geometric::find_clearance(checker, q, CollisionMonitor::kNear);
    if (pair.distance < CollisionMonitor::kNear) {
      report.closest = pair;
      report.points = finder.between(pair.a, pair.b, q);
    }
  }
  return report;
}

}  // namespace

CollisionMonitor::CollisionMonitor(QObject* parent)
    : QObject(parent), thread_([this](const std::stop_token& stop) { work(stop); }) {}

CollisionMonitor::~CollisionMonitor() {
  thread_.request_stop();
  wake_.notify_all();
}

void CollisionMonitor::set_problem(std::shared_ptr<const PreparedProblem> problem) {
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  next_.reset();
  answered_ = asked_;
}

void CollisionMonitor::check(const Configuration& q) {
  {
    const std::lock_guard lock(mutex_);
    next_ = q;
    next_ticket_ = ++asked_;
  }
  wake_.notify_all();
}

void CollisionMonitor::work(const std::stop_token& stop) {
  std::shared_ptr<const PreparedProblem> problem;
  std::unique_ptr<CollisionChecker> checker;
  std::unique_ptr<geometric::ClosestPointFinder> finder;
  while (true) {
    Configuration q;
    int ticket = 0;
    bool is_new = false;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return next_.has_value(); })) {
        return;
      }
      q = *std::exchange(next_, std::nullopt);
      ticket = next_ticket_;
      is_new = problem != problem_;
      problem = problem_;
    }
    const auto deliver = [this, ticket, problem](auto report) {
      QMetaObject::invokeMethod(
          this,
          [this, ticket, problem, report = std::move(report)] {
            answered_ = std::max(answered_, ticket);
            if (problem == problem_) {
              report();
            }
          },
          Qt::QueuedConnection);
    };
    try {
      if (is_new) {
        checker.reset();
        if (problem) {
          const PreparedProblem::Problem prepared = problem->wait(stop);
          if (!prepared) {
            return;
          }
          checker = prepared->checker->clone();
          finder = std::make_unique<geometric::ClosestPointFinder>(checker->shared_world());
        }
      }
      CollisionReport report = checker ? report_on(*checker, *finder, q) : CollisionReport{};
      deliver([this, report = std::move(report)] { emit checked(report); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  }
}

}  // namespace handway::gui
