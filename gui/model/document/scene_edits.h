#pragma once

#include "handway/geometric/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::gui {

/// What a person edits: a scene that never changes itself. An edit makes a new
/// state of an old one.
struct SceneState {
  std::shared_ptr<const geometric::Scene> scene;

  [[nodiscard]] bool is_hidden(std::string_view object) const { return display_of(object).hidden; }
  [[nodiscard]] bool is_locked(std::string_view object) const { return display_of(object).locked; }
  [[nodiscard]] geometric::ObjectDisplay display_of(std::string_view object) const {
    return scene ? scene->display.of(object) : geometric::ObjectDisplay{};
  }
  /// nullptr if there is no such object.
  [[nodiscard]] const geometric::SceneObject* find(std::string_view object) const {
    return scene ? geometric::find_object(*scene, object) : nullptr;
  }

  friend bool operator==(const SceneState&, const SceneState&) = default;
};

using ObjectChange = std::function<void(geometric::SceneObject&)>;
using DisplayChange = std::function<void(geometric::ObjectDisplay&)>;

/// `name`, or `name` with the first number that makes it unlike all other names:
/// "can", "can 2", "can 3", ….
[[nodiscard]] std::string unused_name(const geometric::Scene& scene, const std::string& name);

/// @param object gets an unused name.
[[nodiscard]] SceneState with_object(const SceneState& state, geometric::SceneObject object);
/// Constraints about them go, too.
[[nodiscard]] SceneState without_objects(const SceneState& state,
                                         const std::vector<std::string>& names);
/// @param change of anything but the name. Constraints about what is detached go.
[[nodiscard]] SceneState with_changed_object(const SceneState& state, std::string_view name,
                                             const ObjectChange& change);
[[nodiscard]] SceneState with_changed_objects(const SceneState& state,
                                              const std::vector<std::string>& names,
                                              const ObjectChange& change);
/// @param change of how the window treats each of these objects.
[[nodiscard]] SceneState with_changed_display(const SceneState& state,
                                              const std::vector<std::string>& names,
                                              const DisplayChange& change);
[[nodiscard]] SceneState with_renamed_object(const SceneState& state, const std::string& name,
                                             const std::string& new_name);
/// In place of the one of that name, or as a new one. @param constraint about one of
/// constrainable_bodies().
[[nodiscard]] SceneState with_constraint(const SceneState& state,
                                         geometric::PathConstraint constraint);
[[nodiscard]] SceneState without_constraint(const SceneState& state, std::string_view name);
/// `name`, or the first like it that no constraint has.
[[nodiscard]] std::string unused_constraint_name(const geometric::Scene& scene,
                                                 const std::string& name);
[[nodiscard]] SceneState with_base(const SceneState& state, std::string_view robot,
                                   const geometric::Pose& X_WB);
[[nodiscard]] SceneState with_start(const SceneState& state, const geometric::Configuration& q);
[[nodiscard]] SceneState with_goal(const SceneState& state, const geometric::Configuration& q);
/// In place of the one of that name, or as a new one.
[[nodiscard]] SceneState with_posture(const SceneState& state,
                                      const geometric::NamedPosture& posture);
[[nodiscard]] SceneState without_posture(const SceneState& state, std::string_view name);

/// `group`, or the first like it that no object is in: "group", "group 2", ….
[[nodiscard]] std::string unused_group(const geometric::Scene& scene, const std::string& group);

/// Where a link of a robot is in the world, the first robot standing at `q`.
/// Nothing if there is no such link.
[[nodiscard]] std::optional<geometric::Pose> link_pose(const geometric::Scene& scene,
                                                       const geometric::Configuration& q,
                                                       std::string_view robot,
                                                       std::string_view link);

/// Where what a constraint is about is in the world, the first robot standing at `q`.
/// Nothing if it is none of constrainable_bodies().
[[nodiscard]] std::optional<geometric::Pose> body_pose(const geometric::Scene& scene,
                                                       const geometric::Configuration& q,
                                                       std::string_view body);

/// The body's axis that is nearest to the vertical at `q` stays within 10° of it.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] geometric::PathConstraint new_upright(const geometric::Scene& scene,
                                                    const geometric::Configuration& q,
                                                    const std::string& body);
/// The body's origin stays in a box with room around where it is at `q`, at start and at goal.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] geometric::PathConstraint new_region(const geometric::Scene& scene,
                                                   const geometric::Configuration& q,
                                                   const std::string& body);

/// Where an object is in the world, the first robot standing at `q`.
[[nodiscard]] geometric::Pose object_pose(const geometric::Scene& scene,
                                          const geometric::Configuration& q,
                                          const geometric::SceneObject& object);

/// `X_WO` in the frame that `object` is placed in: the world, or its link.
[[nodiscard]] geometric::Pose in_parent(const geometric::Scene& scene,
                                        const geometric::Configuration& q,
                                        const geometric::SceneObject& object,
                                        const geometric::Pose& X_WO);

}  // namespace handway::gui
