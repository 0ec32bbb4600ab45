#include "model/document/collision_monitor.h"

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

CollisionMonitor::CollisionMonitor(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &CollisionMonitor::failed);
}

void CollisionMonitor::set_problem(std::shared_ptr<const PreparedProblem> problem) {
  job_.cancel();
  if (problem && !problem->if_ready()) {
    emit outdated();
  }
  checks_ = problem ? std::make_shared<Checks>(Checks{OwnChecker(std::move(problem))}) : nullptr;
}

void CollisionMonitor::check(const Configuration& q) {
  job_.run_next([this, checks = checks_, q](const std::stop_token& stop) -> LatestJob::Answer {
    CollisionReport report;
    if (checks) {
      CollisionChecker* checker = checks->checker.wait(stop);
      if (!checker) {
        return {};
      }
      if (!checks->finder) {
        checks->finder = std::make_unique<geometric::ClosestPointFinder>(checker->shared_world());
      }
      report = report_on(*checker, *checks->finder, q);
    }
    return [this, report = std::move(report)] { emit checked(report); };
  });
}

}  // namespace handway::gui
