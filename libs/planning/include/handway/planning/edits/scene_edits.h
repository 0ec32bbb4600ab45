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

/// The robot that is called so, or has a link that is; empty: there is none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string owner_of_name(const geometric::Scene& scene,
                                                                const std::string& name);

/// `name`, or `name` with the first number that makes it unlike all other names:
/// "can", "can 2", "can 3", ….
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_name(const geometric::Scene& scene,
                                                              const std::string& name);

/// @throws InputError if there are no names, or, naming the nearest object, if the scene lacks one
/// of these objects.
HANDWAY_PLANNING_EXPORT void need_objects(const geometric::Scene& scene,
                                          const std::vector<std::string>& names);

/// @param object gets an unused name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_object(const SceneState& state,
                                                             geometric::SceneObject object);
/// Constraints about them go, too.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
without_objects(const SceneState& state, const std::vector<std::string>& names);
/// @param change of anything but the name. Constraints about what is detached go.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_object(const SceneState& state,
                                                                     std::string_view name,
                                                                     const ObjectChange& change);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_objects(
    const SceneState& state, const std::vector<std::string>& names, const ObjectChange& change);
/// @param change of how the window treats each of these objects.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_changed_display(
    const SceneState& state, const std::vector<std::string>& names, const DisplayChange& change);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_renamed_object(const SceneState& state,
                                                                     const std::string& name,
                                                                     const std::string& new_name);
/// Adds a constraint, or replaces the one of that name. @param constraint about one of
/// constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_constraint(const SceneState& state, geometric::PathConstraint constraint);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_constraint(const SceneState& state,
                                                                    std::string_view name);
/// `name`, or the first like it that no constraint has.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_constraint_name(
    const geometric::Scene& scene, const std::string& name);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_base(const SceneState& state,
                                                           std::string_view robot,
                                                           const geometric::Pose& X_WB);
/// The goal keeps to the start in what does not move.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_start(const SceneState& state,
                                                            const geometric::Configuration& q);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_goal(const SceneState& state,
                                                           const geometric::Configuration& q);
/// The goal pose of that number changed, or, one after the last, a new one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_goal_pose(const SceneState& state,
                                                                std::size_t index,
                                                                const geometric::PoseGoal& goal);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_goal_pose(const SceneState& state,
                                                                   std::size_t index);
/// Adds a posture, or replaces the one of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_posture(const SceneState& state, const geometric::NamedPosture& posture);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_posture(const SceneState& state,
                                                                 std::string_view name);
/// Adds `view`, or replaces the view of that name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_saved_view(const SceneState& state,
                                                                 const geometric::SavedView& view);
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState without_saved_view(const SceneState& state,
                                                                    std::string_view name);
/// The hand is planned for with a basis, which the scene names by its file.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
with_basis(const SceneState& state, const std::filesystem::path& file,
           std::shared_ptr<const sampling::PmdBasis> basis);

/// `group`, or the first like it that no object is in: "group", "group 2", ….
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unused_group(const geometric::Scene& scene,
                                                               const std::string& group);

/// Returns the pose in the world of a constrained body, with the first robot at `q`; nothing if it
/// is none of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<geometric::Pose> body_pose(
    const geometric::Scene& scene, const geometric::Configuration& q, std::string_view body);

/// The body's axis that is nearest to the vertical at `q` stays within 10° of it.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::PathConstraint new_upright(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& body);
/// The body's origin stays in a box with room around where it is at `q`, at start and at goal.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::PathConstraint new_region(
    const geometric::Scene& scene, const geometric::Configuration& q, const std::string& body);

}  // namespace handway::planning
