#pragma once

#include "handway/planning/core/algorithm_observer.h"
#include "handway/planning/core/plan_result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// One step of a run, kept.
struct RecordedStep {
  planning::AlgorithmStep step;  ///< Its q is null: see `sample`.
  int sample = -1;               ///< Index into RecordedRun::samples; -1: none.
};

/// A run of pmd-prm or full-prm, step by step.
struct RecordedRun {
  std::vector<RecordedStep> steps;
  std::vector<geometric::Configuration> samples;
  std::vector<int> nodes;  ///< Of each node of the roadmap: its index in samples.
  std::vector<std::pair<std::string, std::string>> pairs;  ///< Names of the world's pairs.
  std::uint64_t left_out = 0;                              ///< Steps after the last one kept.
  planning::PlanResult result;
  /// Parameters by which the run departed from the paper's listings, as "rho_max 0.05 (printed:
  /// 0)".
  std::vector<std::string> departures;

  /// The roadmap's nodes, and its edges, once `count` steps are done.
  [[nodiscard]] int nodes_after(std::size_t count) const;
  [[nodiscard]] std::vector<std::pair<int, int>> edges_after(std::size_t count) const;
};

/// Keeps the first steps of a run, so many that memory stays small.
class RunRecorder : public planning::AlgorithmObserver {
 public:
  explicit RunRecorder(std::size_t most_steps) : most_steps_(most_steps) {}

  void on_step(const planning::AlgorithmStep& step) override;
  /// @param world of the problem's checker, which names pairs.
  [[nodiscard]] RecordedRun take(planning::PlanResult result,
                                 const geometric::CollisionWorld& world);

 private:
  std::size_t most_steps_;
  RecordedRun run_;
};

}  // namespace handway::gui
