#include "workers/plan_runner.h"

#include <QElapsedTimer>

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kReportEveryMs = 120;

}  // namespace

// Lives on the planner's thread; gathers and passes on now and then, so that
// a fast planner does not flood the event queue.
class PlanRunner::Reporter : public planning::Observer {
 public:
  Reporter(PlanRunner& runner, const planning::PlanningProblem& problem, int palm_link)
      : runner_(runner),
        problem_(problem),
        palm_link_(palm_link),
        X_BL_(static_cast<std::size_t>(problem.model().link_count())) {
    clock_.start();
  }

  void on_node(const planning::NodeEvent& node) override {
    problem_.model().forward_kinematics(node.q, X_BL_);
    palms_.push_back(problem_.scene->robots.front().X_WB *
                     X_BL_[static_cast<std::size_t>(palm_link_)].translation());
    flush(false);
  }

  void on_progress(double fraction, std::string_view activity) override {
    fraction_ = fraction;
    activity_ = QString::fromUtf8(activity.data(), static_cast<int>(activity.size()));
    flush(false);
  }

  void flush(bool now) {
    if (!now && clock_.elapsed() < kReportEveryMs) {
      return;
    }
    clock_.restart();
    QMetaObject::invokeMethod(
        &runner_,
        [&runner = runner_, fraction = fraction_, activity = activity_,
         palms = std::exchange(palms_, {})] {
          emit runner.progressed(fraction, activity);
          if (!palms.empty()) {
            emit runner.nodes_found(palms);
          }
        },
        Qt::QueuedConnection);
  }

 private:
  PlanRunner& runner_;
  const planning::PlanningProblem& problem_;
  int palm_link_;
  std::vector<geometric::Pose> X_BL_;
  std::vector<Eigen::Vector3d> palms_;
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
        reporter.flush(true);
      }
      end([this, result = std::move(result)] { emit finished(result); });
    } catch (const std::exception& error) {
      end([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  });
}

void PlanRunner::cancel() { thread_.request_stop(); }

}  // namespace handway::gui
