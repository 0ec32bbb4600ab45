#include "model/planning/plan_runner.h"

#include "model/planning/palm_roadmap.h"

#include <QElapsedTimer>

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kReportEveryMs = 120;

}  // namespace

// Lives on the planner's thread; gathers and passes on now and then, so that
// a fast planner does not flood the event queue.
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

  void tell() {
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
      tell();
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

PlanRunner::PlanRunner(QObject* parent) : QObject(parent) {}

PlanRunner::~PlanRunner() = default;

void PlanRunner::start(std::shared_ptr<planning::Planner> planner,
                       std::shared_ptr<const PreparedProblem> problem,
                       const planning::PlanRequest& request, int palm_link) {
  running_ = true;
  emit progressed(0.0, tr("preparing collision checks"));
  const auto end = [this](auto report) {
    QMetaObject::invokeMethod(
        this,
        [this, report = std::move(report)] {
          running_ = false;
          report();
        },
        Qt::QueuedConnection);
  };
  thread_ = std::jthread([this, end, planner = std::move(planner), problem = std::move(problem),
                          request, palm_link](const std::stop_token& stop) {
    try {
      planning::PlanResult result;
      result.status = planning::PlanStatus::kCancelled;
      if (const PreparedProblem::Problem prepared = problem->wait(stop)) {
        Reporter reporter(*this, *prepared, palm_link);
        result = planner->plan(*prepared, request, stop, &reporter);
        reporter.tell();
      }
      end([this, result = std::move(result)] { emit finished(result); });
    } catch (const std::exception& error) {
      end([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  });
}

void PlanRunner::cancel() { thread_.request_stop(); }

}  // namespace handway::gui
