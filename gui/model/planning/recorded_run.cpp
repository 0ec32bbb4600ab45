#include "model/planning/recorded_run.h"

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

}  // namespace handway::gui
