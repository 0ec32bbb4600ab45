#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/planners/hand_space.h"
#include "handway/planning/planners/target_region.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/search_space.h"

#include <Eigen/Core>

#include <cstdint>

namespace handway::planning {

/// Where trees grow towards: over all joints anywhere, with PMDs into the
/// paper's regions (sections 4.2 and 5.1).
class TargetDraws {
 public:
  /// All that is passed must outlive this object.
  TargetDraws(const PlanningProblem& problem, const TargetRegion& region, HandSpace hand,
              const SearchSpace& space, std::uint64_t seed);

  /// A target in the coordinates of the search space for the tree of an end (0: start, 1: goal).
  struct Target {
    Eigen::VectorXd coordinates;
    int pmds = 0;      ///< Principal directions it was drawn from.
    double rho = 0.0;  ///< Half-width of the arm's region.
  };
  /// @param failures draws before this one, since the last that was of use: the
  /// hand is drawn from its free joints and one direction first, and from one
  /// more with every failure (Algorithm 4).
  [[nodiscard]] Target draw(int sample, int end, int failures) const;

  /// `target` with the arm or the hand as at `from`, in this share of the samples: to
  /// open around an object and to draw back from it are hard to find as one motion.
  [[nodiscard]] Eigen::VectorXd held(Eigen::VectorXd target, const Eigen::VectorXd& from,
                                     int sample, double share) const;

  /// A target near the node at `from`, wherever that is: in a random direction of the arm or
  /// of the hand; or further along the edge from its parent, with a deviation.
  [[nodiscard]] Target draw_near_node(int sample, const Eigen::VectorXd& from,
                                      const Eigen::VectorXd& parent) const;

 private:
  [[nodiscard]] Eigen::VectorXd direction(Eigen::Index size, sampling::RandomStream& draw) const;
  [[nodiscard]] Target draw_in_corridor(int sample, int axes, sampling::RandomStream& draw) const;
  [[nodiscard]] Target draw_near_end(int end, int axes, sampling::RandomStream& draw) const;

  const PlanningProblem& problem_;
  const TargetRegion& region_;
  const SearchSpace& space_;
  bool in_regions_;
  sampling::PmdBasis basis_;
  sampling::RandomStream draws_;
};

}  // namespace handway::planning
