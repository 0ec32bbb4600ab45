#pragma once

#include "handway/planning/edits/scene_state.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace handway::tools {

/// Goals as poses of a link, from the command line.
struct GoalPoseOptions {
  std::vector<std::string> poses;  ///< "[LINK:]X,Y,Z[,ROLL,PITCH,YAW]", m and degrees.
  std::string link;                ///< Link of poses that name none; empty: hand or tool.
  std::vector<double> tolerance;   ///< mm and degrees; empty: as a scene's.
};

/// Adds `--goal-pose`, which is repeatable, `--goal-link` and `--goal-tolerance`.
void add_goal_pose_options(CLI::App& command, GoalPoseOptions& options);

/// Replaces the scene's goal by the goal poses; its values remain for joints that don't move their
/// links. Does nothing without poses. @throws InputError for a link that the robot lacks or that no
/// joint moves.
void set_goal_poses(const GoalPoseOptions& options, planning::SceneState& scene);

}  // namespace handway::tools
