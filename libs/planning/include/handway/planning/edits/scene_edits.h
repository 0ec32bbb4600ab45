#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::planning {

/// Changes an object, but for its name.
using ObjectChange = std::function<void(geometric::SceneObject&)>;
/// Changes the way in which the window shows and treats an object.
using DisplayChange = std::function<void(geometric::ObjectDisplay&)>;

/// Returns the robot that has this name, or a link of this name; empty if there is none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string owner_of_name(const geometric::Scene& scene,
                                                                const std::string& name);

/// Returns `name`, or `name` with the first number that makes it different from all other names:
/// "can", "can 2", "can 3", ….
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_name(const geometric::Scene& scene,
                                                              const std::string& name);

/// Returns what messages about a scene begin with: its file, or its name if it has no file.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string source_of(const geometric::Scene& scene);

/// Returns the object of that name.
/// @throws InputError, naming the object with the most similar name, if the scene has none.
HANDWAY_PLANNING_EXPORT const geometric::SceneObject& need_object(const geometric::Scene& scene,
                                                                  std::string_view name);
/// @throws InputError if there are no names, or as need_object().
HANDWAY_PLANNING_EXPORT void need_objects(const geometric::Scene& scene,
                                          const std::vector<std::string>& names);

/// Adds an object, under an unused name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_object(const SceneState& state,
                                                             geometric::SceneObject object);
/// Removes objects and the constraints about them.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
without_objects(const SceneState& state, const std::vector<std::string>& names);
/// Changes an object. Constraints about an object that is detached are removed.
/// @param change Changes anything but the name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_object(const SceneState& state,
                                                                     std::string_view name,
                                                                     const ObjectChange& change);
/// Changes several objects in the same way, as with_changed_object() does.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_objects(
    const SceneState& state, const std::vector<std::string>& names, const ObjectChange& change);
/// Changes the way in which the window shows and treats objects.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_display(
    const SceneState& state, const std::vector<std::string>& names, const DisplayChange& change);
/// Renames an object, also in its display and in the pairs and constraints that name it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_renamed_object(const SceneState& state,
                                                                     const std::string& name,
                                                                     const std::string& new_name);
/// Adds a constraint, or replaces the one of that name. @param constraint about one of
/// constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_constraint(const SceneState& state, geometric::PathConstraint constraint);
/// Removes the constraint of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_constraint(const SceneState& state,
                                                                    std::string_view name);
/// Returns `name`, or the first similar name that no constraint has.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_constraint_name(
    const geometric::Scene& scene, const std::string& name);
/// Moves the base of a robot to the pose `X_WB` in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_base(const SceneState& state,
                                                           std::string_view robot,
                                                           const geometric::Pose& X_WB);
/// Sets the start. Joints that do not move have the start's values in the goal, too.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_start(const SceneState& state,
                                                            const geometric::Configuration& q);
/// Sets the goal and removes the goal poses. Joints that do not move keep the start's values.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_goal(const SceneState& state,
                                                           const geometric::Configuration& q);
/// Replaces the goal pose of that number; beyond the last one, adds it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_goal_pose(const SceneState& state,
                                                                std::size_t index,
                                                                const geometric::PoseGoal& goal);
/// Removes the goal pose of that number.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_goal_pose(const SceneState& state,
                                                                   std::size_t index);
/// Throws an InputError unless a frame can be added to the scene, or can replace the one of its
/// name: its name is used for something else, or it has no such parent.
HANDWAY_PLANNING_EXPORT void check_frame(const geometric::Scene& scene,
                                         const geometric::NamedFrame& frame);
/// Adds a frame, or replaces the one of that name.
/// @throws as check_frame().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_frame(const SceneState& state,
                                                            const geometric::NamedFrame& frame);
/// Removes the frame of that name. Goals that it led stay where they are.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_frame(const SceneState& state,
                                                               std::string_view name);
/// Renames a frame, also in the goals and programs that name it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_renamed_frame(const SceneState& state,
                                                                    const std::string& name,
                                                                    const std::string& new_name);
/// Returns the pose of a frame in the world, with the first robot at `q`; nothing if its parent is
/// not there.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<geometric::Pose> frame_pose(
    const geometric::Scene& scene, const geometric::Configuration& q,
    const geometric::NamedFrame& frame);
/// Adds a posture, or replaces the one of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_posture(const SceneState& state, const geometric::NamedPosture& posture);
/// Removes the posture of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_posture(const SceneState& state,
                                                                 std::string_view name);
/// Adds `view`, or replaces the view of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_saved_view(const SceneState& state,
                                                                 const geometric::SavedView& view);
/// Removes the view of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_saved_view(const SceneState& state,
                                                                    std::string_view name);
/// Sets the hand's basis, which the scene names by its file.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_basis(const SceneState& state, const std::filesystem::path& file,
           std::shared_ptr<const sampling::PmdBasis> basis);

/// Returns `group`, or the first similar name that no group has: "group", "group 2", ….
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_group(const geometric::Scene& scene,
                                                               const std::string& group);

/// Returns the pose in the world of a constrained body, with the first robot at `q`; nothing if it
/// is none of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<geometric::Pose> body_pose(
    const geometric::Scene& scene, const geometric::Configuration& q, std::string_view body);

/// Returns a constraint that keeps the body's axis that is nearest to the vertical at `q` within
/// 10° of the vertical.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::PathConstraint new_upright(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& body);
/// Returns a constraint that keeps the body's origin in a box around its positions at `q`, at the
/// start and at the goal, with 0.1 m of room.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::PathConstraint new_region(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& body);

}  // namespace handway::planning
