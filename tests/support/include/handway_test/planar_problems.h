#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway_test/solid_robots.h"

#include <array>

/// Small problems of planar_hand_arm() that take a planner a moment.
namespace handway::test {

/// A configuration of planar_hand_arm(), rad.
[[nodiscard]] geometric::Configuration planar_configuration(double shoulder, double elbow,
                                                            double thumb = 0.0, double left = 0.0,
                                                            double right = 0.0);

/// Returns the basis of its hand: the thumb free, one direction that spreads both fingers, one that
/// spreads one and closes the other.
[[nodiscard]] sampling::PmdBasis planar_hand_basis();

/// The query in `scene`, whose robot is planar_hand_arm(), with the basis above.
[[nodiscard]] planning::PlanningProblem planar_problem(geometric::Scene scene,
                                                       const geometric::Configuration& start,
                                                       const geometric::Configuration& goal);

/// Returns a problem without obstacles between start and goal.
[[nodiscard]] planning::PlanningProblem open_problem();

/// The stretched hand sweeps across a post: the fingers have to spread.
[[nodiscard]] planning::PlanningProblem post_problem();

/// A robot like it whose shoulder turns without end, with nothing near it, from one angle of the
/// shoulder to another.
[[nodiscard]] planning::PlanningProblem endless_problem(double shoulder_start,
                                                        double shoulder_goal);

/// Returns this problem from 2.7 rad to -2.7 rad, with a wall in the way of the shorter arc.
[[nodiscard]] planning::PlanningProblem endless_problem_with_wall();

/// Start and goal are free, but the goal's upper arm stands between two walls
/// that it can't pass.
[[nodiscard]] planning::PlanningProblem walled_in_problem();

}  // namespace handway::test
