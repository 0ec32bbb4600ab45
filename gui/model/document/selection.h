#pragma once

#include "handway/planning/edits/scene_state.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace handway::gui {

/// Item of a scene that a user can point at.
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
    kGoalPose,
    kFrame
  };

  Kind kind = Kind::kNone;
  std::string robot;  ///< For kRobot and kLink.
  std::string name;   ///< For kLink, kObject, kGroup, kFrame; for kGoalPose its number, from 0.

  /// A posture of the first robot, that is moved by its palm: where it is, start or goal.
  [[nodiscard]] bool is_posture() const {
    return kind == Kind::kPalm || kind == Kind::kStart || kind == Kind::kGoal;
  }

  friend bool operator==(const SceneItem&, const SceneItem&) = default;
};

/// Hit of a pointer in the view.
struct SceneHit {
  SceneItem item;
  Eigen::Vector3d point;  ///< World, m.
};

/// Selected items: any number of objects, or one item of another kind.
struct Selection {
  SceneItem item;                         ///< The one that was selected last.
  std::vector<std::string> objects = {};  ///< All that are selected; the last is `item`.

  friend bool operator==(const Selection&, const Selection&) = default;
};

[[nodiscard]] SceneItem object_item(const std::string& name);
[[nodiscard]] SceneItem goal_pose_item(std::size_t index);
[[nodiscard]] SceneItem frame_item(const std::string& name);
/// The frame that the item stands for; nullptr if it is none of the scene's.
[[nodiscard]] const geometric::NamedFrame* find_frame(const planning::SceneState& state,
                                                      const SceneItem& item);
/// The goal pose that the item stands for; nullptr if it is none of the scene's.
[[nodiscard]] const geometric::PoseGoal* find_goal_pose(const planning::SceneState& state,
                                                        const SceneItem& item);

/// One item, whatever it is.
[[nodiscard]] Selection selection_of(const SceneItem& item);
/// Returns a selection of these objects, each once; the others are aligned to the last one.
[[nodiscard]] Selection selection_of(std::vector<std::string> objects);

/// Returns the selection after a click on an object: it with its group, or it alone if exactly that
/// group is selected already.
[[nodiscard]] Selection clicked(const planning::SceneState& state, const Selection& now,
                                const SceneItem& item);
/// Returns the selection after a click with Ctrl or Shift: the items of a plain click are added to
/// the selection, or removed if they were in it.
[[nodiscard]] Selection toggled(const planning::SceneState& state, const Selection& now,
                                const SceneItem& item);
/// Returns the part of the selection that is still in the scene.
[[nodiscard]] Selection still_there(const planning::SceneState& state, Selection selection);

}  // namespace handway::gui
