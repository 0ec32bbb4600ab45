#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <string>

namespace handway::geometric {

/// Makes the model of a robot of several parts (compose_robots()), and names the parts' links and
/// joints. Links next to a mount may touch, and so may links of different parts that overlap in
/// every sampled posture, with a warning in the description.
///
/// Joints keep their values; those of new parts get the part's neutral posture.
/// @pre robot.parts has at least two parts, carriers before the parts on them.
/// @throws InputError if a carrier has no such link, or the parts make no valid robot.
HANDWAY_GEOMETRIC_EXPORT void compose_parts(RobotInstance& robot);

/// Mounts a robot of the scene, with all that it carries, on a link of another one: it becomes a
/// part of that robot. Settings of the scene that name joints and links stay valid.
/// @param carrier name of a robot or of a part. @param link by the carrier's own name.
/// @param X_LB base of the mounted robot in that link.
/// @throws InputError if there is no such robot or link, or the carrier is the robot itself; the
/// scene is then unchanged.
HANDWAY_GEOMETRIC_EXPORT void mount_robot(Scene& scene, const std::string& robot,
                                          const std::string& carrier, const std::string& link,
                                          const Pose& X_LB);

/// Moves a mounted part to another pose in the link that carries it.
/// @throws InputError if no part of that name is mounted.
HANDWAY_GEOMETRIC_EXPORT void move_mount(Scene& scene, const std::string& part, const Pose& X_LB);

/// Takes a part, with all that it carries, off the robot that carries it: it is fixed to the world
/// from now on, in its pose with its robot at `configuration`, after that robot. Settings of the
/// first robot's links and joints that are gone are removed.
/// @throws InputError if no part of that name is mounted.
HANDWAY_GEOMETRIC_EXPORT void unmount_robot(Scene& scene, const std::string& part);

/// Removes a robot or a mounted part, with all robots that it carries. Objects that it carries stay
/// in place. With the first robot, start, goal and all its other settings are removed.
/// @throws InputError if there is no such robot.
HANDWAY_GEOMETRIC_EXPORT void remove_robot(Scene& scene, const std::string& name);

/// Makes a robot that is fixed to the world the first, which is planned for. Start, goal and all
/// other settings of the former one are removed.
/// @throws InputError if there is no such robot.
HANDWAY_GEOMETRIC_EXPORT void put_first(Scene& scene, const std::string& name);

}  // namespace handway::geometric
