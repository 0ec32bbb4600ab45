#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/queries/region_draws.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace handway::planning {

/// Where the palm goes in one hypercube B^a(p_i) of a corridor.
struct PalmBox {
  geometric::Pose X_WC;       ///< Middle, axes along the palm's widest ways.
  Eigen::Vector3d half_size;  ///< m
  double step = 0.0;          ///< p_i: share of the arm's way from start (0) to goal (1).
};

/// Boxes around the palm's places in the hypercubes of a region's corridor (paper, section 5.1,
/// Fig. 12), for people to see where a planner samples. A hypercube has as many dimensions as the
/// arm has joints, and the palm three: a box holds the palm's places in all corners and in the
/// middle of its hypercube, and so nearly all in between. Axes are those of the corners'
/// spread. Hypercubes none of whose corners the arm reaches have no box.
/// @param palm link of the robot. @param most boxes: of more hypercubes every n-th has one.
/// @param stop gives what there is by then.
/// @throws InputError if a corridor of tool poses is asked for and the arm has no
/// closed-form inverse kinematics.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<PalmBox> palm_boxes(
    const PlanningProblem& problem, int palm, const SamplingRegion& region, int most,
    const std::stop_token& stop = {});

}  // namespace handway::planning
