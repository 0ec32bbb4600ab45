#pragma once

#include "handway/planning/export.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/hand_arm_region.h"
#include "handway/planning/spaces/state_space.h"

#include <string>
#include <vector>

namespace handway::planning {

/// When PmdPrm compares numSamples with N.
enum class SampleLimit {
  kEachTrial,  ///< Before each hand trial; free ones count, too.
  kEachPass,   ///< At the end of a pass, failed trials alone, as printed (Algorithm 4).
};

/// Settings of PmdPrm. Symbols are the paper's (sections 5 and 7, Table 3). Algorithm 4 as printed
/// is `rho_max` = 0, `fill_gaps` = false, SampleLimit::kEachPass and SmoothingEdges::kBothWays.
struct PmdPrmSettings {
  double rho_a = 0.001;   ///< ρ_a at the start: half-side of the hypercubes, normalised.
  double rho_max = 0.05;  ///< Largest ρ_a: "good results … between 0.001 and 0.05". 0: no limit.
  bool fill_gaps = true;  ///< Sample in the middle of a search range without any hypercube.
  int n_checked = static_cast<int>(SampleLimit::kEachTrial);  ///< A SampleLimit.
  int smoothing = static_cast<int>(SmoothingEdges::kForwards);
  int corridor = static_cast<int>(CorridorForm::kJoint);  ///< A CorridorForm.
  int n_a = 10;               ///< n_A: arm configurations per hypercube.
  int n_h = 10;               ///< n_H: hand configurations per arm configuration.
  int k = 10;                 ///< K: neighbours to connect to.
  int max_samples = 1000000;  ///< N: hand trials in all.
  int max_pmds = 4;           ///< Most principal directions used together.
  int arm_trials = 10;        ///< Draws for an arm free of self-collision (Algorithm 1).
};

/// The paper's planner: a probabilistic roadmap of hand-arm configurations, the
/// arm drawn from a corridor around the straight motion, the hand from the
/// subspace of the thumb base and a few principal motion directions.
///
/// Source: Rosell, Suárez, Rosales, Pérez, "Autonomous motion planning of a
/// hand-arm robotic system based on captured human-like hand postures",
/// Autonomous Robots 31, 2011, Algorithms 1 to 4.
class HANDWAY_PLANNING_EXPORT PmdPrm final : public Planner {
 public:
  explicit PmdPrm(HandSpace space);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PlannerCapabilities capabilities() const override;

  [[nodiscard]] PmdPrmSettings& settings() { return settings_; }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;
  [[nodiscard]] std::vector<BoundParameter> own_parameters() override;

 private:
  HandSpace space_;
  PmdPrmSettings settings_;
};

}  // namespace handway::planning
