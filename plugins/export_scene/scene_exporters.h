#pragma once

#include "handway/planning/extensions/exporter.h"

namespace handway::export_scene {

/// Scenes for MoveIt: the first robot as URDF and SRDF, `scene.yaml` (moveit_msgs/PlanningScene)
/// and, with a start and a goal, `request.yaml` (moveit_msgs/MotionPlanRequest) for the group
/// `all_joints`, which is added. Poses are in the frame of the robot's root link, so that they are
/// valid for any place of it in MoveIt. Other robots become objects, link by link.
///
/// Messages: http://docs.ros.org/en/noetic/api/moveit_msgs/html/index-msg.html
class MoveitSceneExporter final : public planning::SceneExporter {
 public:
  [[nodiscard]] std::string name() const override { return "moveit-scene"; }
  [[nodiscard]] std::string description() const override {
    return "URDF and SRDF of the robot, and the scene as MoveIt's messages";
  }

 protected:
  [[nodiscard]] std::vector<std::filesystem::path> do_write(const geometric::Scene& scene,
                                                            const std::filesystem::path& folder,
                                                            const std::string& stem) const override;
};

/// Scenes as binary glTF 2.0 (`STEM.glb`), for slides and other viewers: the visible geometry of
/// all robots in their poses, the first one at the scene's start, and all objects that are not
/// hidden, each a node of its name. Y is up, as glTF has it; edges below 40° are shaded smoothly.
class GltfExporter final : public planning::SceneExporter {
 public:
  [[nodiscard]] std::string name() const override { return "gltf"; }
  [[nodiscard]] std::string description() const override {
    return "glTF 2.0 of the scene, for slides and viewers";
  }

 protected:
  [[nodiscard]] std::vector<std::filesystem::path> do_write(const geometric::Scene& scene,
                                                            const std::filesystem::path& folder,
                                                            const std::string& stem) const override;
};

}  // namespace handway::export_scene
