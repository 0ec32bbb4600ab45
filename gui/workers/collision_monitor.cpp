#include "workers/collision_monitor.h"

#include "handway/geometric/collision/make_checker.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {
namespace {

using geometric::CollisionChecker;
using geometric::Configuration;

CollisionReport report_on(CollisionChecker& checker, const Configuration& q) {
  CollisionReport report;
  report.collisions = geometric::find_collisions(checker, q);
  if (report.collisions.empty()) {
    const geometric::NamedPair pair =
        geometric::find_clearance(checker, q, CollisionMonitor::kNear);
    if (pair.distance < CollisionMonitor::kNear) {
      report.closest = pair;
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

void CollisionMonitor::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  const std::lock_guard lock(mutex_);
  scene_ = std::move(scene);
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
  std::shared_ptr<const geometric::Scene> scene;
  std::unique_ptr<CollisionChecker> checker;
  while (true) {
    Configuration q;
    int ticket = 0;
    bool scene_changed = false;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return next_.has_value(); })) {
        return;
      }
      q = *std::exchange(next_, std::nullopt);
      ticket = next_ticket_;
      scene_changed = scene != scene_;
      scene = scene_;
    }
    const auto deliver = [this, ticket, scene](auto report) {
      QMetaObject::invokeMethod(
          this,
          [this, ticket, scene, report = std::move(report)] {
            answered_ = std::max(answered_, ticket);
            if (scene == scene_) {
              report();
            }
          },
          Qt::QueuedConnection);
    };
    try {
      if (scene_changed) {
        checker.reset();
        if (scene && !scene->robots.empty()) {
          checker = geometric::make_collision_checker(
              std::make_shared<const geometric::CollisionWorld>(*scene));
        }
      }
      CollisionReport report = checker ? report_on(*checker, q) : CollisionReport{};
      deliver([this, report = std::move(report)] { emit checked(report); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  }
}

}  // namespace handway::gui
