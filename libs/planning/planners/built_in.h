#pragma once

#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/planning/spaces/target_sampler.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {

[[nodiscard]] inline bool with_pmds(HandSpace space) {
  return space == HandSpace::kPrincipalDirections;
}

/// Planner with the name, description and capabilities given to its constructor.
class BuiltInPlanner : public Planner {
 public:
  BuiltInPlanner(std::string name, std::string description, PlannerCapabilities capabilities)
      : name_(std::move(name)), description_(std::move(description)), capabilities_(capabilities) {}

  [[nodiscard]] std::string name() const final { return name_; }
  [[nodiscard]] std::string description() const final { return description_; }
  [[nodiscard]] PlannerCapabilities capabilities() const final { return capabilities_; }

 private:
  std::string name_;
  std::string description_;
  PlannerCapabilities capabilities_;
};

/// The built-in planners; their parameters describe them.
///
/// The default. Runs a portfolio of searches and takes the path of the first to find one. Trees in
/// the joint corridor start alone; if they don't find a path soon, other searches join: expansive
/// trees (see RrtConnectSettings::expansions; in poses of the tool if the arm has closed-form
/// inverse kinematics), the same from another seed, and trees over all joints. Budgets are counted
/// in configurations, so that the winner is the same for any number of threads. The path is then
/// optimised.
///
/// Samples hand postures in the PMD subspace of the basis; without a basis every joint separately.
[[nodiscard]] std::unique_ptr<Planner> make_auto_planner();
inline constexpr const char* kAutoPlanner = "auto";  ///< Its name.

/// Initial region of each search of that planner, in the order of NodeEvent::search.
[[nodiscard]] std::vector<TargetRegion> regions_of_auto_planner();

/// The paper's planner: a probabilistic roadmap of hand-arm configurations, the
/// arm drawn from a corridor around the straight motion, the hand from the
/// subspace of the thumb base and a few principal motion directions. The algorithms as printed
/// are the preset `print`, what the authors' program does otherwise is `authors`.
///
/// Source: Rosell, Suárez, Rosales, Pérez, "Autonomous motion planning of a
/// hand-arm robotic system based on captured human-like hand postures",
/// Autonomous Robots 31, 2011, Algorithms 1 to 4.
[[nodiscard]] std::unique_ptr<Planner> make_pmd_prm(HandSpace hand);

/// A roadmap in the paper's sampling regions whose edges are checked only along the shortest path
/// from start to goal; refused edges are removed, and new nodes are added when no path is left,
/// from a corridor that widens.
///
/// Source: Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000,
/// doi:10.1109/ROBOT.2000.844107. Nodes are checked when they are drawn.
[[nodiscard]] std::unique_ptr<Planner> make_pmd_lazy();

/// BidirectionalSearch, then smoothing.
[[nodiscard]] std::unique_ptr<Planner> make_rrt_connect(HandSpace hand);

}  // namespace handway::planning
