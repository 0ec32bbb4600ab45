#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/exporter.h"

namespace handway::test {

/// solid_tx90_sah() alone in space.
[[nodiscard]] planning::PlanningProblem tx90_sah_problem();

/// Four waypoints of tx90_sah_problem(): hand and arm move, then the hand alone, then both.
[[nodiscard]] planning::Path tx90_sah_path();

/// Returns that path timed at `speed`, with arcs or with stops.
[[nodiscard]] planning::Motion tx90_sah_motion(bool arcs = true, double speed = 1.0);

}  // namespace handway::test
