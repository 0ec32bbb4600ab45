#pragma once

#include "model/document/scene_edits.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace handway::gui {

/// Something in a scene that a person can point at.
struct SceneItem {
  enum class Kind {
    kNone,
    kRobot,
    kLink,
    kObject,
    kGroup,
    kSeveral,
    kStart,
    kGoal,
    kPalm,
    kGoalPose
  };

  Kind kind = Kind::kNone;
  std::string robot;  ///< Of kRobot and kLink.
  std::string name;   ///< Of kLink, kObject and kGroup; of kGoalPose its number, from 0.

  /// A posture of the first robot, that is moved by its palm: where it is, start or goal.
  [[nodiscard]] bool is_posture() const {
    return kind == Kind::kPalm || kind == Kind::kStart || kind == Kind::kGoal;
  }

  friend bool operator==(const SceneItem&, const SceneItem&) = default;
};

/// What a pointer meets in the view.
struct SceneHit {
  SceneItem item;
  Eigen::Vector3d point;  ///< World, m.
};

/// What is selected: any number of objects, or one thing of another kind.
struct Selection {
  SceneItem item;                         ///< The one that was selected last.
  std::vector<std::string> objects = {};  ///< All that are selected; the last is `item`.

  friend bool operator==(const Selection&, const Selection&) = default;
};

[[nodiscard]] SceneItem object_item(const std::string& name);
[[nodiscard]] SceneItem goal_pose_item(std::size_t index);
/// The goal pose that the item stands for; nullptr if it is none of the scene's.
[[nodiscard]] const geometric::PoseGoal* find_goal_pose(const SceneState& state,
                                                        const SceneItem& item);

/// One item, whatever it is.
[[nodiscard]] Selection selection_of(const SceneItem& item);
/// These objects, each once; the last is the one that others are aligned to.
[[nodiscard]] Selection selection_of(std::vector<std::string> objects);

/// The objects of a group, as the scene lists them.
[[nodiscard]] std::vector<std::string> group_members(const geometric::Scene& scene,
                                                     const std::string& group);

/// What a click on an object selects: it with its group, but it alone if just that
/// group is selected already.
[[nodiscard]] Selection clicked(const SceneState& state, const Selection& now,
                                const SceneItem& item);
/// What a click with Ctrl or Shift selects: what it would without is added to what
/// is selected now, or taken away if it was.
[[nodiscard]] Selection toggled(const SceneState& state, const Selection& now,
                                const SceneItem& item);
/// What of it is still in the scene.
[[nodiscard]] Selection still_there(const SceneState& state, Selection selection);

/// The objects in parts that move as one: each group that is selected whole, and each other
/// object by itself; in the order of the selection.
[[nodiscard]] std::vector<std::vector<std::string>> rigid_parts(
    const geometric::Scene& scene, const std::vector<std::string>& objects);

}  // namespace handway::gui
