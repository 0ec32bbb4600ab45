#pragma once

#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/hand_arm_region.h"
#include "handway/planning/spaces/target_sampler.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Settings of RrtConnect. Lengths in joints normalised to [0, 1]; with a
/// Cartesian corridor the arm's as make_corridor_space() has them.
struct RrtConnectSettings {
  double range = 0.3;   ///< Longest step of a tree.
  int refinements = 0;  ///< Steps tried, each a quarter of the one before, when one is not free.
  int max_samples = 1000000;
  int smoothing_checks = 300;  ///< Configurations that ShortcutSmoothing may check.
  double single_moves = 0.3;   ///< Share that move the arm alone or the hand alone; PMDs only.
  double expansions = 0.0;     ///< Share of steps that expand a node instead; PMDs only.
  TargetRegion region;         ///< PMDs only.
};

/// Two trees that grow towards random samples and towards each other. Over all
/// joints it is the usual baseline. With PMDs it draws from the paper's regions:
/// the arm from a corridor that widens, the hand from thumb base and PMDs; and
/// from balls around start and goal, where passages are narrowest. Its edges are
/// sampled at first, and made certain only where trees meet. A share of its steps may go from a
/// node that few others were tried from to somewhere near it: such trees get out of places that
/// are too tight for targets beyond them to be of use.
///
/// Sources: Kuffner, LaValle, "RRT-Connect: an efficient approach to single-query
/// path planning", ICRA 2000, doi:10.1109/ROBOT.2000.844730;
/// Hsu, Latombe, Motwani, "Path planning in expansive configuration spaces", ICRA 1997,
/// doi:10.1109/ROBOT.1997.619371 (expansions);
/// Sánchez, Latombe, "A single-query bi-directional probabilistic roadmap planner
/// with lazy collision checking", ISRR 2001 (both, and edges checked late).
class HANDWAY_PLANNING_EXPORT RrtConnect final : public Planner {
 public:
  explicit RrtConnect(HandSpace space);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PlannerCapabilities capabilities() const override;

  [[nodiscard]] RrtConnectSettings& settings() { return settings_; }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;
  [[nodiscard]] std::vector<BoundParameter> own_parameters() override;

 private:
  HandSpace space_;
  RrtConnectSettings settings_;
};

}  // namespace handway::planning
