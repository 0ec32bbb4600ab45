#pragma once

#include <Eigen/Core>

#include <string>

namespace handway::gui {

/// Something in a scene that a person can point at.
struct SceneItem {
  enum class Kind { kNone, kRobot, kLink, kObject, kGroup, kSeveral, kStart, kGoal, kPalm };

  Kind kind = Kind::kNone;
  std::string robot;  ///< Of kRobot and kLink.
  std::string name;   ///< Of kLink, kObject and kGroup.

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

}  // namespace handway::gui
