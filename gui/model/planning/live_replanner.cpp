#include "model/planning/live_replanner.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/replanning/dynamic_roadmap.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {
namespace {

using planning::DynamicRoadmap;
using planning::Path;
using planning::PlanResult;

constexpr double kTimeLimit = 2.0;  // s, of one query

/// Answers the first query with a path that is known already.
class KnownPathFirst : public planning::Planner {
 public:
  KnownPathFirst(Path path, std::unique_ptr<Planner> rest)
      : path_(std::move(path)), rest_(std::move(rest)) {
    objective() = rest_->objective();
  }

  [[nodiscard]] std::string name() const override { return rest_->name(); }
  [[nodiscard]] std::string description() const override { return rest_->description(); }
  [[nodiscard]] planning::PlannerCapabilities capabilities() const override {
    return rest_->capabilities();
  }

 protected:
  void do_plan(planning::PlanningContext& context, PlanResult& result) override {
    if (path_.waypoints.empty()) {
      rest_->plan_within(context, result);
      return;
    }
    result.path = std::exchange(path_, {});
    result.status = planning::PlanStatus::kSolved;
  }
  [[nodiscard]] std::vector<planning::BoundParameter> own_parameters() override { return {}; }

 private:
  Path path_;
  std::unique_ptr<Planner> rest_;
};

// A roadmap whose first path is one that was planned for `problem`.
std::unique_ptr<DynamicRoadmap> roadmap_of(const planning::PlanningProblem& problem, Path path,
                                           const planning::PlanRequest& request,
                                           const std::stop_token& stop) {
  auto roadmap = std::make_unique<DynamicRoadmap>(
      problem, std::make_unique<KnownPathFirst>(std::move(path),
                                                planning::PlannerRegistry().create("auto")));
  (void)roadmap->plan(request, stop);
  return roadmap;
}

}  // namespace

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
  std::unique_ptr<DynamicRoadmap> roadmap;
  planning::PlanRequest request;
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
        roadmap.reset();
        if (const PreparedProblem::Problem problem = start->problem->wait(cancelled)) {
          request = start->request;
          request.time_limit_s = std::min(request.time_limit_s, kTimeLimit);
          roadmap = roadmap_of(*problem, std::move(start->path), request, cancelled);
        }
      } else if (roadmap && roadmap->follow(*scene)) {
        DerivedResult result{roadmap->plan(request, cancelled), revision};
        deliver([this, result = std::move(result),
                 origin = QString::fromLatin1(planning::to_string(roadmap->source()))] {
          emit replanned(result, origin);
        });
      } else {
        roadmap.reset();
        deliver([this] { emit lost(); });
      }
    } catch (const std::exception&) {  // a scene that makes no problem; planning it says why
      roadmap.reset();
      deliver([this] { emit lost(); });
    }
  }
}

}  // namespace handway::gui
