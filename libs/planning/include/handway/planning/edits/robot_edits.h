#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Edits of a scene's robots: adding, mounting on each other, removing. `q` is always the first
/// robot's configuration.

namespace handway::planning {

/// A link of a robot or of a part of one.
struct LinkOfRobot {
  std::string robot;  ///< Name of the robot or part.
  std::string link;   ///< The link's name in that robot or part.

  friend bool operator==(const LinkOfRobot&, const LinkOfRobot&) = default;
};

/// Returns the link that carries a mounted part; nothing for a robot that stands in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<LinkOfRobot> carrier_of(
    const geometric::Scene& scene, const std::string& robot);
/// Returns the links that `robot` can be mounted on: all links of robots and parts that it does not
/// carry itself.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<LinkOfRobot> mounting_places(
    const geometric::Scene& scene, const std::string& robot);
/// Returns the last link of the first robot if that is an arm without a hand: hands and tools are
/// mounted on it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<LinkOfRobot> end_of_arm(
    const geometric::Scene& scene);
/// Returns a link of a composed robot by its part and its name in that part.
[[nodiscard]] HANDWAY_PLANNING_EXPORT LinkOfRobot own_link(const geometric::Scene& scene,
                                                           const std::string& robot,
                                                           const std::string& link);
/// Returns the pose of the base (root link) of a robot or part in the world; nothing if there is
/// none of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<geometric::Pose> base_pose(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& robot);
/// Returns the pose of the frame that a robot's pose is given in: the world, or the link that
/// carries it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::Pose carrier_pose(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& robot);

/// Returns the first hand basis of the library whose joints the robot has, and its name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<std::pair<std::string, sampling::PmdBasis>>
fitting_basis(const geometric::RobotModel& model);

/// Adds a robot that stands at its X_WB or is mounted, and takes a hand basis that fits the first
/// robot. @param robot with an unused name, see unused_name().
/// @param X_LB of its base in the link `on`.
/// @throws InputError if the parts make no robot, or names clash with those of objects.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_robot(const SceneState& state,
                                                            const geometric::Configuration& q,
                                                            geometric::RobotInstance robot,
                                                            const std::optional<LinkOfRobot>& on,
                                                            const geometric::Pose& X_LB);
/// Returns whether the group names a robot beside the first one, or a joint of it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool joins_robots(const geometric::Scene& scene,
                                                        const std::vector<std::string>& group);
/// Sets the group that moves; see geometric::set_moving_group().
/// @throws InputError as that does.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_group(const SceneState& state,
                                                            const geometric::Configuration& q,
                                                            const std::vector<std::string>& group);
/// Mounts a robot or part, with all that it carries, on another link.
/// @throws InputError as geometric::mount_robot().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_mount(const SceneState& state,
                                                            const geometric::Configuration& q,
                                                            const std::string& robot,
                                                            const LinkOfRobot& on,
                                                            const geometric::Pose& X_LB);
/// Removes the mount of a part, which stays at its pose in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_mount(const SceneState& state,
                                                               const geometric::Configuration& q,
                                                               const std::string& part);
/// Moves the base of a mounted part to a pose in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_mount_at(const SceneState& state,
                                                               const geometric::Configuration& q,
                                                               const std::string& part,
                                                               const geometric::Pose& X_WB);
/// Replaces the model by another one with the same joints and links, and composes the parts again.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_model(const SceneState& state, const geometric::Configuration& q, const std::string& robot,
           const std::shared_ptr<const geometric::RobotModel>& model);
/// @pre it is not the only robot. See geometric::remove_robot().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_robot(const SceneState& state,
                                                               const geometric::Configuration& q,
                                                               const std::string& robot);
/// Makes another robot the first, which is planned for. Start, goal and all settings of the former
/// first robot are removed.
/// @param robot stands in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_first_robot(const SceneState& state,
                                                                  const geometric::Configuration& q,
                                                                  const std::string& robot);

}  // namespace handway::planning
