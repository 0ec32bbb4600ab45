#include "model/planning/live_replanner.h"

#include "model/planning/followed_path.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {

LiveReplanner::LiveReplanner(QObject* parent)
    : QObject(parent), thread_([this](const std::stop_token& stop) { work(stop); }) {}

LiveReplanner::~LiveReplanner() {
  thread_.request_stop();
  {
    const std::lock_guard guard(mutex_);
    running_.request_stop();
  }
  wake_.notify_all();
}

void LiveReplanner::begin(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                          const planning::PlanRequest& request) {
  end();
  ++generation_;
  {
    const std::lock_guard guard(mutex_);
    start_ = Start{std::move(problem), std::move(path), request};
    wanted_ = generation_;
  }
  wake_.notify_all();
}

void LiveReplanner::end() {
  ended_ = generation_;
  answered_ = asked_;
  const std::lock_guard guard(mutex_);
  start_.reset();
  scene_.reset();
  running_.request_stop();
}

void LiveReplanner::follow(std::shared_ptr<const geometric::Scene> scene,
                           const planning::Revision& revision) {
  if (!is_active()) {
    return;
  }
  {
    const std::lock_guard guard(mutex_);
    scene_ = std::move(scene);
    revision_ = revision;
    ticket_ = ++asked_;
  }
  wake_.notify_all();
}

void LiveReplanner::work(const std::stop_token& stop) {
  std::unique_ptr<FollowedPath> path;
  int generation = 0;
  while (true) {
    std::optional<Start> start;
    std::shared_ptr<const geometric::Scene> scene;
    planning::Revision revision;
    std::stop_token cancelled;
    int ticket = 0;
    {
      std::unique_lock guard(mutex_);
      if (!wake_.wait(guard, stop, [this] { return start_ || scene_; })) {
        return;
      }
      running_ = {};
      cancelled = running_.get_token();
      start = std::exchange(start_, std::nullopt);
      // A path comes first; the scene stays for the next round.
      scene = start ? nullptr : std::exchange(scene_, nullptr);
      revision = revision_;
      ticket = ticket_;
      generation = start ? wanted_ : generation;
    }
    const auto deliver = [this, generation, ticket](auto report) {
      QMetaObject::invokeMethod(
          this,
          [this, generation, ticket, report = std::move(report)] {
            if (generation == generation_ && is_active()) {
              answered_ = std::max(answered_, ticket);
              report();
            }
          },
          Qt::QueuedConnection);
    };
    try {
      if (start) {
        path.reset();
        if (const PreparedProblem::Problem problem = start->problem->wait(cancelled)) {
          path = std::make_unique<FollowedPath>(*problem, std::move(start->path), start->request,
                                                cancelled);
        }
      } else if (path && path->move_to(*scene)) {
        DerivedResult result{path->plan(cancelled), revision};
        deliver([this, result = std::move(result),
                 way = QString::fromLatin1(planning::to_string(path->source()))] {
          emit replanned(result, way);
        });
      } else {
        path.reset();
        deliver([this] { emit lost(); });
      }
    } catch (const std::exception&) {  // a scene that makes no problem; planning it says why
      path.reset();
      deliver([this] { emit lost(); });
    }
  }
}

}  // namespace handway::gui
