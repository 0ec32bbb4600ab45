#include "model/planning/microscope.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace lines = planning::algorithm_lines;

int RecordedRun::nodes_after(std::size_t count) const {
  const auto end = steps.begin() + static_cast<std::ptrdiff_t>(std::min(count, steps.size()));
  return static_cast<int>(std::count_if(steps.begin(), end, [](const RecordedStep& recorded) {
    return recorded.step.line == lines::kAddNode;
  }));
}

std::vector<std::pair<int, int>> RecordedRun::edges_after(std::size_t count) const {
  std::vector<std::pair<int, int>> edges;
  for (std::size_t i = 0; i < std::min(count, steps.size()); ++i) {
    if (steps[i].step.line == lines::kAddEdge) {
      edges.emplace_back(steps[i].step.from, steps[i].step.to);
    }
  }
  return edges;
}

void RunRecorder::on_step(const planning::AlgorithmStep& step) {
  if (run_.steps.size() >= most_steps_) {
    ++run_.left_out;
    return;
  }
  RecordedStep recorded{step, -1};
  recorded.step.q = nullptr;
  if (step.q) {
    recorded.sample = static_cast<int>(run_.samples.size());
    run_.samples.push_back(*step.q);
  }
  if (step.line == lines::kAddNode) {
    run_.nodes.push_back(recorded.sample);
  }
  run_.steps.push_back(recorded);
}

RecordedRun RunRecorder::take(planning::PlanResult result, const geometric::CollisionWorld& world) {
  for (int check = 0; check < world.check_count(); ++check) {
    const geometric::NamedPair pair = named_pair(world, check, 0.0);
    run_.pairs.emplace_back(pair.a, pair.b);
  }
  run_.result = std::move(result);
  return std::move(run_);
}

namespace {

using planning::AlgorithmLine;

constexpr std::size_t kMostSteps = 50000;  // some 10 MB

bool lets_through(StepFilter filter, AlgorithmLine line) {
  switch (filter) {
    case StepFilter::kSamples:
      return line.algorithm <= 2 || line == lines::kAddNode;
    case StepFilter::kEdges:
      return line == lines::kAddNode || line == lines::kLocalPlan || line == lines::kAddEdge ||
             line == lines::kJoined;
    case StepFilter::kAll:
      break;
  }
  return true;
}

std::vector<Eigen::Vector3d> palms_of(const RecordedRun& run,
                                      const planning::PlanningProblem& problem, int palm) {
  const geometric::RobotInstance& robot = problem.scene->robots.front();
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  std::vector<Eigen::Vector3d> palms;
  for (const int sample : run.nodes) {
    robot.model->forward_kinematics(run.samples[static_cast<std::size_t>(sample)], X_BL);
    palms.push_back(robot.X_WB * X_BL[static_cast<std::size_t>(palm)].translation());
  }
  return palms;
}

std::vector<std::string> departures_of(planning::Planner& planner) {
  std::vector<std::string> texts;
  for (const geometric::Parameter& parameter : geometric::departures(planner.parameters())) {
    texts.push_back(fmt::format("{} {} (printed: {})", parameter.key, geometric::to_text(parameter),
                                parameter.as_printed));
  }
  return texts;
}

}  // namespace

Microscope::Microscope(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &Microscope::failed);
}

void Microscope::record(std::shared_ptr<planning::Planner> planner,
                        std::shared_ptr<const PreparedProblem> problem,
                        const planning::PlanRequest& request, int palm) {
  forget();
  job_.run([this, planner = std::move(planner), prepared = std::move(problem), request,
            palm](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem ready = prepared->wait(stop);
    if (!ready) {
      return {};
    }
    RunRecorder recorder(kMostSteps);
    planning::PlanResult result = planner->plan(*ready, request, stop, &recorder);
    auto run =
        std::make_shared<RecordedRun>(recorder.take(std::move(result), ready->checker->world()));
    run->departures = departures_of(*planner);
    if (run->steps.empty()) {
      return [this, reason = QString::fromStdString(run->result.reason)] { emit failed(reason); };
    }
    return [this, run, palms = palms_of(*run, *ready, palm)] {
      run_ = run;
      palms_ = palms;
      position_ = 0;
      emit recorded();
      emit moved();
    };
  });
}

void Microscope::forget() {
  job_.cancel();
  run_.reset();
  palms_.clear();
  position_ = 0;
  emit moved();
}

void Microscope::go_to(std::size_t position) {
  if (run_) {
    position_ = std::min(position, run_->steps.size() - 1);
    emit moved();
  }
}

bool Microscope::go(int direction, StepFilter filter) {
  if (!run_) {
    return false;
  }
  const auto count = static_cast<std::ptrdiff_t>(run_->steps.size());
  for (auto i = static_cast<std::ptrdiff_t>(position_) + direction; i >= 0 && i < count;
       i += direction) {
    if (lets_through(filter, run_->steps[static_cast<std::size_t>(i)].step.line)) {
      go_to(static_cast<std::size_t>(i));
      return true;
    }
  }
  return false;
}

}  // namespace handway::gui
