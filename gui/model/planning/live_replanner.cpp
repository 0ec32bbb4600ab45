#include "model/planning/live_replanner.h"

#include "handway/planning/replanning/dynamic_roadmap.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

using planning::DynamicRoadmap;
using planning::Path;

constexpr double kTimeLimit = 2.0;  // s, of one query

}  // namespace

/// A path, and the roadmap that keeps it valid once that is made.
struct LiveReplanner::Followed {
  std::shared_ptr<const PreparedProblem> problem;  ///< Null once the roadmap is made, or can't be.
  Path path;
  planning::PlanRequest request;
  std::unique_ptr<DynamicRoadmap> roadmap = nullptr;

  void prepare(const std::stop_token& stop) {
    const auto prepared = std::exchange(problem, nullptr);
    if (const PreparedProblem::Problem ready = prepared ? prepared->wait(stop) : nullptr) {
      request.time_limit_s = std::min(request.time_limit_s, kTimeLimit);
      roadmap = std::make_unique<DynamicRoadmap>(*ready);
      roadmap->adopt(path);
    }
  }
};

LiveReplanner::LiveReplanner(QObject* parent) : QObject(parent) {
  // A scene that makes no problem; planning it says why.
  connect(&job_, &LatestJob::failed, this, &LiveReplanner::lost);
}

void LiveReplanner::begin(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                          const planning::PlanRequest& request) {
  end();
  followed_ = std::make_shared<Followed>(Followed{std::move(problem), std::move(path), request});
  job_.run([followed = followed_](const std::stop_token& stop) -> LatestJob::Answer {
    followed->prepare(stop);
    return {};
  });
}

void LiveReplanner::end() {
  job_.cancel();
  if (followed_) {
    // A large roadmap takes a while to go.
    run_in_background(
        [followed = std::exchange(followed_, nullptr)]() mutable { followed.reset(); });
  }
}

void LiveReplanner::follow(std::shared_ptr<const geometric::Scene> scene,
                           std::shared_ptr<const PreparedProblem> problem) {
  const planning::Revision revision = problem->revision();
  replan(
      [scene = std::move(scene), problem = std::move(problem)](DynamicRoadmap& roadmap,
                                                               const std::stop_token& stop) {
        const PreparedProblem::Problem ready = problem->wait(stop);
        // A scene without start or goal got them for the problem alone.
        return ready && ready->scene == scene && roadmap.follow(*ready);
      },
      revision);
}

void LiveReplanner::try_scene(std::shared_ptr<const geometric::Scene> scene) {
  replan([scene = std::move(scene)](DynamicRoadmap& roadmap,
                                    const std::stop_token&) { return roadmap.follow(*scene); },
         {});
}

void LiveReplanner::replan(Change change, const planning::Revision& revision) {
  if (!is_active()) {
    return;
  }
  job_.run_next([this, followed = followed_, change = std::move(change),
                 revision](const std::stop_token& stop) -> LatestJob::Answer {
    followed->prepare(stop);
    auto roadmap = std::exchange(followed->roadmap, nullptr);  // gone if anything goes wrong
    if (!roadmap || !change(*roadmap, stop)) {
      return [this] { emit lost(); };
    }
    DerivedResult result{roadmap->plan(followed->request, stop), revision};
    const QString origin = QString::fromLatin1(planning::to_string(roadmap->source()));
    followed->roadmap = std::move(roadmap);
    return [this, result = std::move(result), origin] { emit replanned(result, origin); };
  });
}

}  // namespace handway::gui
