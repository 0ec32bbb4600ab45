#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/state_space.h"

#include <optional>
#include <stop_token>
#include <vector>

namespace handway::planning {

/// The region from which a planner samples (paper, section 5.1): the arm's corridor around its
/// straight motion, and a part of the hand's box B^h.
struct SamplingRegion {
  CorridorForm corridor = CorridorForm::kJoint;
  double rho_a = 0.1;  ///< Half-width of the corridor, normalised.
  HandSpace hand = HandSpace::kPrincipalDirections;
  int pmds = 1;  ///< Principal directions that are used together, beside the free joints.
};

/// The region that `planner` begins with, by its parameters; with all the principal directions that
/// it may use of a basis with so many. Nothing if it samples everywhere.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<SamplingRegion> first_region(Planner& planner,
                                                                                 int directions);

/// Returns one region for each search of the planner, in the order of NodeEvent::search; a planner
/// without several searches has one. Empty if it samples everywhere.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<SamplingRegion> first_regions(Planner& planner,
                                                                                int directions);

/// Palms and fingertips in configurations sampled from a region; in the world, m.
struct RegionDraws {
  std::vector<Eigen::Vector3d> palms;       ///< One for each configuration that the arm reaches.
  std::vector<Eigen::Vector3d> fingertips;  ///< One for each finger and configuration.
  std::vector<Eigen::Vector3d> motion;      ///< The palm on the straight motion, start to goal.
  std::vector<Eigen::Vector3d> centres;     ///< The palm in the hypercubes' middles; empty if many.
  int hypercubes = 0;                       ///< Hypercubes of the corridor.
  double palm_reach = 0.0;  ///< Distance from the straight motion's palm that nine tenths of the
                            ///< palms don't exceed, m.
};

/// Samples configurations from a region of a problem, free or not, to show the effect of a
/// parameter.
/// @param palm link of the robot. @param configurations number of samples, the same for the same
/// arguments; samples of a region are those of a smaller one, moved outwards.
/// @param stop gives what there is by then.
/// @throws InputError if a corridor of tool poses is requested and the arm has fewer than six
/// joints, or principal directions without a basis.
[[nodiscard]] HANDWAY_PLANNING_EXPORT RegionDraws draw_region(const PlanningProblem& problem,
                                                              int palm,
                                                              const SamplingRegion& region,
                                                              int configurations,
                                                              const std::stop_token& stop = {});

/// Box around the palm's positions in one hypercube B^a(p_i) of a corridor.
struct PalmBox {
  geometric::Pose X_WC;       ///< Middle, axes along the palm's widest extents.
  Eigen::Vector3d half_size;  ///< m
  double step = 0.0;          ///< p_i: share of the arm's motion from start (0) to goal (1).
};

/// Boxes around the palm's places in the hypercubes of a region's corridor (paper, section 5.1,
/// Fig. 12), to show where a planner samples. A hypercube has as many dimensions as the arm has
/// joints, and the palm three: a box holds the palm's places in all corners and in the middle of
/// its hypercube, and so nearly all in between. Axes are those of the corners' spread. Hypercubes
/// none of whose corners the arm reaches have no box.
/// @param palm link of the robot. @param most boxes: with more hypercubes every n-th has one.
/// @param stop gives what there is by then.
/// @throws InputError if a corridor of tool poses is requested and the arm has fewer than six
/// joints.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<PalmBox> palm_boxes(
    const PlanningProblem& problem, int palm, const SamplingRegion& region, int most,
    const std::stop_token& stop = {});

}  // namespace handway::planning
