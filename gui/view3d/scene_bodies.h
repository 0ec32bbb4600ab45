#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/document/body_display.h"
#include "model/document/scene_item.h"
#include "model/document/selection.h"
#include "view3d/object_node.h"
#include "view3d/robot_node.h"

#include <memory>
#include <string>
#include <vector>

class SoNode;
class SoPath;
class SoSeparator;

namespace handway::gui {

class StillSplit;

/// The drawings of a scene's robots and objects, and where each stands.
class SceneBodies {
 public:
  SceneBodies();
  ~SceneBodies();

  /// Draws another scene; null: nothing.
  void show(std::shared_ptr<const geometric::Scene> scene);
  /// Draws an edited scene with the same robots; makes anew only what looks different.
  void update(std::shared_ptr<const geometric::Scene> scene);
  [[nodiscard]] const std::shared_ptr<const geometric::Scene>& scene() const { return scene_; }

  /// Moves the first robot, and what all robots carry. @pre has_robot().
  void place(const geometric::Configuration& q);
  /// Stands an object or a robot's base elsewhere, for a while.
  void preview(const SceneItem& item, const geometric::Pose& X_WO);
  /// Draws meshes in place of the bodies' looks, where there are any.
  void stand_in(const BodyMeshes& meshes);
  /// Paints these bodies (names as in CollisionWorld) as colliding, and no others.
  /// @returns whether something looks different that stands still, as `split` has it.
  bool set_colliding(const std::vector<std::string>& bodies, const StillSplit& split);

  [[nodiscard]] bool has_robot() const { return !robots_.empty(); }
  /// The one that moves. @pre has_robot().
  [[nodiscard]] RobotNode& first_robot() const { return *robots_.front(); }
  [[nodiscard]] const LinkShapes& first_robot_shapes() const { return shapes_.front(); }
  /// Of the first robot, shape [variable_count].
  [[nodiscard]] const geometric::Configuration& configuration() const { return q_; }

  /// All that is not hidden.
  [[nodiscard]] std::vector<SoNode*> shown() const;
  /// The same but for the first robot, apart: what stands still, and what is carried or can be
  /// seen through.
  struct Others {
    std::vector<SoNode*> still;
    std::vector<SoNode*> moving;
  };
  [[nodiscard]] Others others() const;
  /// The drawings of what is selected.
  [[nodiscard]] std::vector<SoSeparator*> parts_of(const Selection& selection) const;
  /// What a picked drawing stands for; kNone if it is none of these.
  [[nodiscard]] SceneItem item_of(const SoPath& path) const;

 private:
  void make_objects();
  void place_attached();

  std::shared_ptr<const geometric::Scene> scene_;
  std::vector<LinkShapes> shapes_;  ///< By robot.
  geometric::Configuration q_;
  std::vector<std::unique_ptr<RobotNode>> robots_;
  std::vector<std::unique_ptr<ObjectNode>> objects_;
};

}  // namespace handway::gui
