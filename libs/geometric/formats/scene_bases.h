#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <memory>
#include <vector>

namespace handway::geometric {

/// `model`, with a root that moves if the robot's "moving_base" asks for it, and slides of its
/// bases within the robot's "bounds".
/// @throws InputError naming the line.
[[nodiscard]] std::shared_ptr<const RobotModel> with_bases(
    const YamlElement& robot, const std::shared_ptr<const RobotModel>& model);

/// Gives slides of bases that the robot's "bounds" do not name those of the scene: the box around
/// objects, robots, start, goal and goal poses, larger by kAroundScene each way.
/// @param robots the elements of the scene's robots, in which bounds are looked up.
void bound_bases(const std::vector<YamlElement>& robots, Scene& scene);

}  // namespace handway::geometric
