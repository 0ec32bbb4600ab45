#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// A scene file's `goal_pose`: one goal, or a list of them.
/// @param model the planned robot, whose links they name.
[[nodiscard]] std::vector<PoseGoal> pose_goals_of(const YamlElement& element,
                                                  const RobotModel& model);

/// The same as text; empty without goals.
[[nodiscard]] std::string pose_goals_text(const std::vector<PoseGoal>& goals);

}  // namespace handway::geometric
