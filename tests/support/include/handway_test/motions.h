#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/exporter.h"
#include "handway/planning/timing/time_path.h"

#include <string>
#include <vector>

namespace handway::test {

/// solid_tx90_sah() alone in space.
[[nodiscard]] planning::PlanningProblem tx90_sah_problem();

/// Four waypoints of tx90_sah_problem(): hand and arm move, then the hand alone, then both.
[[nodiscard]] planning::Path tx90_sah_path();

/// Returns that path timed at `speed`, with arcs or with stops.
[[nodiscard]] planning::Motion tx90_sah_motion(bool arcs = true, double speed = 1.0);
/// Returns that path timed with these options.
[[nodiscard]] planning::Motion tx90_sah_motion(const planning::TimingOptions& options);

/// Returns a motion with limited jerk of the shipped arm of seven joints, panda_class.
/// @param options whose limits are replaced.
[[nodiscard]] planning::Motion panda_motion(planning::TimingOptions options = {});

/// Returns the motion of the same robot under another name, without a file.
[[nodiscard]] planning::Motion with_robot_name(planning::Motion motion, const std::string& name);

/// Returns tx90_sah_motion() with stages: "approach", "close" of the object "can", while the hand
/// moves alone, and "lift".
[[nodiscard]] planning::Motion with_stages(planning::Motion motion);

/// Returns the motion with more stages at its end: it sets outputs, and waits for `wait` s.
[[nodiscard]] planning::Motion with_outputs_and_wait(
    planning::Motion motion, const std::vector<geometric::OutputStep>& outputs, double wait);

}  // namespace handway::test
