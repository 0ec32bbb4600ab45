#include "model/planning/plan_runner.h"

#include "model/planning/palm_roadmap.h"

#include <QElapsedTimer>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kReportEveryMs = 120;

}  // namespace

// Lives on the planner's thread; gathers progress and passes it on now and then, so that a fast
// planner does not flood the event queue.
class PlanRunner::Reporter : public RoadmapWatch {
 public:
  Reporter(PlanRunner& runner, const planning::PlanningProblem& problem, int palm_link)
      : RoadmapWatch(problem, palm_link), runner_(runner) {
    clock_.start();
  }

  void on_node(const planning::NodeEvent& node) override {
    RoadmapWatch::on_node(node);
    flush();
  }

  void on_progress(double fraction, std::string_view activity) override {
    fraction_ = fraction;
    activity_ = QString::fromUtf8(activity.data(), static_cast<int>(activity.size()));
    flush();
  }

  void notify() {
    QMetaObject::invokeMethod(
        &runner_,
        [&runner = runner_, fraction = fraction_, activity = activity_, roadmap = take()] {
          emit runner.progressed(fraction, activity);
          emit runner.roadmap_found(roadmap);
        },
        Qt::QueuedConnection);
  }

 private:
  void flush() {
    if (clock_.elapsed() < kReportEveryMs) {
      return;
    }
    clock_.restart();
    if (has_news()) {
      notify();
      return;
    }
    QMetaObject::invokeMethod(
        &runner_,
        [&runner = runner_, fraction = fraction_, activity = activity_] {
          emit runner.progressed(fraction, activity);
        },
        Qt::QueuedConnection);
  }

  PlanRunner& runner_;
  double fraction_ = 0.0;
  QString activity_;
  QElapsedTimer clock_;
};

PlanRunner::PlanRunner(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &PlanRunner::failed);
}

PlanRunner::~PlanRunner() { stop_.request_stop(); }

void PlanRunner::start(std::shared_ptr<planning::Planner> planner,
                       std::shared_ptr<const PreparedProblem> problem,
                       const planning::PlanRequest& request, int palm_link) {
  stop_ = {};
  job_.run([this, planner = std::move(planner), problem = std::move(problem), request, palm_link,
            stop = stop_.get_token()](const std::stop_token&) -> LatestJob::Answer {
    planning::PlanResult result;
    result.status = planning::PlanStatus::kCancelled;
    if (const PreparedProblem::Problem prepared = problem->wait(stop)) {
      Reporter reporter(*this, *prepared, palm_link);
      result = planner->plan(*prepared, request, stop, &reporter);
      reporter.notify();
    }
    return [this, result = std::move(result)] { emit finished(result); };
  });
  emit progressed(0.0, tr("preparing collision checks"));
}

void PlanRunner::cancel() { stop_.request_stop(); }

}  // namespace handway::gui
