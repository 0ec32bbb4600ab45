#pragma once

#include "handway/planning/extensions/plugin.h"
#include "problem_files.h"

namespace handway::import_moveit {

/// Reads a problem: moveit_msgs/PlanningScene with the query of a MotionPlanRequest.
///
/// Only the joints of the request's group move. Start: the request's start state over the
/// scene's robot state over the robot's neutral posture. Goal: the joint constraints of the
/// first goal, or poses of links.
///
/// Format: http://docs.ros.org/en/noetic/api/moveit_msgs/html/msg/PlanningScene.html;
/// Chamzas et al., "MotionBenchMaker: a tool to generate and benchmark motion planning
/// datasets", IEEE RA-L 7(2), 2022, doi:10.1109/LRA.2021.3133603.
/// @throws InputError naming file, line, element, the value found and the expected one.
[[nodiscard]] planning::SceneState read_moveit_problem(const ProblemFiles& files);

/// Problems of MoveIt: a planning scene and a motion plan request as YAML files.
class MoveitImporter final : public planning::Importer {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] bool can_read(const std::filesystem::path& file) const override;
  [[nodiscard]] planning::SceneState read(const std::filesystem::path& file) const override;
};

}  // namespace handway::import_moveit
