#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/export.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// Region from which planners with PMDs sample the targets of their searches: around the straight
/// motion of the arm and around both ends. Lengths in joints normalised to [0, 1]; with a Cartesian
/// corridor as make_corridor_space() has them.
struct TargetRegion {
  int corridor = static_cast<int>(CorridorForm::kJoint);  ///< A CorridorForm.
  double near_ends = 0.7;   ///< Share of samples drawn around start and goal.
  double rho_a = 0.1;       ///< Half-width of the arm corridor at the start.
  double rho_max = 0.4;     ///< … and at most.
  double rho_growth = 1.5;  ///< Factor after every `samples_per_width`.
  int samples_per_width = 300;
  double anywhere = 0.0;  ///< Share of samples in the arm's whole range, after two widenings.
  int max_pmds = std::numeric_limits<int>::max();  ///< Most principal directions used together.
};

/// Samples the next targets of a search: over all joints anywhere, with PMDs from the paper's
/// regions (sections 4.2 and 5.1). The points of the unit cube for the regions come from the
/// sampler that the planner's parameter names.
class HANDWAY_PLANNING_EXPORT TargetSampler {
 public:
  /// @param context, region must outlive this object.
  /// @throws InputError as make_corridor_space().
  TargetSampler(PlanningContext& context, const TargetRegion& region, HandSpace hand,
                std::uint64_t seed);
  TargetSampler(const TargetSampler&) = delete;
  TargetSampler& operator=(const TargetSampler&) = delete;
  ~TargetSampler();

  [[nodiscard]] const CorridorSpace& space() const { return region_.space(); }

  /// The configuration at `x`, joints without a coordinate as at `reference`; in a scene with
  /// constraints, a nearby one that keeps them, and `x` becomes its coordinates. Nothing if it does
  /// not exist.
  [[nodiscard]] std::optional<Configuration> configuration(Eigen::VectorXd& x,
                                                           const Configuration& reference) const;

  /// A sample of the target region.
  struct Target {
    Eigen::VectorXd coordinates;  ///< In space().
    int pmds = 0;                 ///< Principal directions it was sampled from.
    double rho = 0.0;             ///< Half-width of the arm's region.
  };
  /// Sample number `sample`, for the search from an end (0: start, 1: goal).
  /// @param failures samples since the last useful one: the hand is sampled from its
  /// free joints and one direction first, and from one more with every failure
  /// (Algorithm 4).
  [[nodiscard]] Target draw(std::uint64_t sample, int end, int failures);

  /// Returns `target` with the arm or the hand as at `from`, in this share of the samples: opening
  /// around an object and retreating from it are hard to find as one motion.
  [[nodiscard]] Eigen::VectorXd held(Eigen::VectorXd target, const Eigen::VectorXd& from,
                                     std::uint64_t sample, double share) const;

  /// A target near the node at `from`, wherever that is: in a random direction of the arm or of the
  /// hand; or further along the edge from its parent, with a deviation.
  [[nodiscard]] Target draw_near_node(std::uint64_t sample, const Eigen::VectorXd& from,
                                      const Eigen::VectorXd& parent) const;

 private:
  [[nodiscard]] Eigen::VectorXd direction(Eigen::Index size, sampling::RandomStream& draw) const;
  [[nodiscard]] Target target(const Eigen::VectorXd& u) const;
  [[nodiscard]] double times_widened() const;
  [[nodiscard]] Eigen::VectorXd in_bounds(const Eigen::VectorXd& u) const;
  [[nodiscard]] Target anywhere(const Eigen::VectorXd& u) const;
  [[nodiscard]] Target in_corridor(const Eigen::VectorXd& u) const;
  [[nodiscard]] Target near_end(const Eigen::VectorXd& u) const;

  /// Interpretation of the next point of the unit cube.
  struct Draw {
    std::uint64_t sample = 0;
    int end = 0;
    int axes = 0;  ///< Axes of the hand.
  };

  const PlanningProblem& problem_;
  const TargetRegion& settings_;
  bool in_regions_;
  HandArmRegion region_;
  geometric::JointIndices planned_;  ///< PlanningProblem::planned_joints().
  sampling::RandomStream stream_;
  Draw draw_;
  std::unique_ptr<sampling::Sampler> points_;
};

/// Descriptions of the parameters of regions.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::BoundParameter corridor_parameter(int& value);

/// Appends all parameters of a region but its corridor and PMDs.
HANDWAY_PLANNING_EXPORT void append_region_parameters(std::vector<geometric::BoundParameter>& list,
                                                      TargetRegion& region);

}  // namespace handway::planning
