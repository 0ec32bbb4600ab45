#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/named_frame.h"
#include "handway/geometric/scene/pose_goal.h"
#include "handway/geometric/scene/program.h"
#include "handway/geometric/scene/scene_display.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace handway::geometric {

/// Planner that a scene requests, as written in its file; the planning layer interprets the
/// words.
struct PlannerRequest {
  std::string name;                                           ///< Empty: the default planner.
  std::vector<std::pair<std::string, std::string>> settings;  ///< Key and value as written.
};

/// An axis of the body stays near a direction of the world: a can that is held upright.
struct OrientationConstraint {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< In the body's frame, not zero.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< In the world, not zero.
  double angle = std::numbers::pi / 18.0;  ///< Largest angle between them, rad; in (0, π].

  friend bool operator==(const OrientationConstraint&, const OrientationConstraint&) = default;
};

/// A point of the body stays in a box.
struct PositionConstraint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< In the body's frame, m.
  Eigen::Vector3d size = Eigen::Vector3d::Ones();   ///< Size of the box, m; each above 0.
  Pose X_WR = Pose::Identity();                     ///< The box's middle and axes in the world.

  friend bool operator==(const PositionConstraint& a, const PositionConstraint& b) {
    return a.point == b.point && a.size == b.size && a.X_WR.matrix() == b.X_WR.matrix();
  }
};

/// Condition on every configuration of a path, besides being free of collisions.
struct PathConstraint {
  std::string name;  ///< Unique among the scene's constraints.
  std::string body;  ///< An object on a link of the planned robot, or one of its links.
  std::variant<OrientationConstraint, PositionConstraint> what;

  friend bool operator==(const PathConstraint&, const PathConstraint&) = default;
};

/// A robot placed in the world.
struct RobotInstance {
  std::string name;
  std::filesystem::path file;  ///< File of the model, as the scene names it.
  std::shared_ptr<const RobotModel> model;
  Pose X_WB = Pose::Identity();  ///< Base (root link) in the world.
  Configuration configuration;   ///< Current configuration; shape [variable_count].
  /// The robots that are mounted on each other to make `model`, the one that is fixed to the world
  /// first: it has the `name` and `file` of this robot. Empty for a robot of one file.
  std::vector<RobotPart> parts = {};
  /// Padding of links, by name, against objects and other robots; objects attached to them have it,
  /// too. It does not apply between the robot's own links.
  std::map<std::string, Padding> padding = {};
};

/// Link to which an object is fixed when it is not fixed to the world.
struct Attachment {
  std::string robot;
  std::string link;
  std::vector<std::string> touching;  ///< Links that may touch it, besides `link`.
};

/// An obstacle for robots, or an object to carry.
struct SceneObject {
  std::string name;
  Shape shape;
  Pose X_PO = Pose::Identity();  ///< In the world, or in the link it is attached to.
  Color color;
  std::optional<Attachment> attachment;
  /// True if a closed shape is filled. False: its surface alone counts, as of a room or a cell.
  bool solid = true;
  /// File of grasps of the object, in its frame; empty: none. Read by planning alone.
  std::filesystem::path grasps = {};
};

/// One problem: robots, objects, a query for the first robot.
struct Scene {
  std::string name;
  std::string description;
  std::filesystem::path file;  ///< Empty for a scene not saved yet.
  std::vector<RobotInstance> robots;
  std::vector<SceneObject> objects;
  std::vector<NamedFrame> frames;
  /// Moving joints of robots[0], by names of groups, parts and joints (named_variables()); its
  /// other joints stay at the start's values. Empty: all move.
  std::vector<std::string> group;
  std::optional<Configuration> start;  ///< Start of robots[0]; empty: its current configuration.
  /// Goal of robots[0]. With goal poses: values of joints that do not move their links, and seed of
  /// the inverse kinematics; the start if empty.
  std::optional<Configuration> goal;
  std::vector<PoseGoal> goal_poses;         ///< Alternative goals; empty: `goal` is the goal.
  std::vector<PathConstraint> constraints;  ///< Constraints on paths of robots[0].
  /// Pairs of bodies (links of robots[0], objects, "robot/link" of others): true: never checked;
  /// false: checked although the robot's own matrix excludes them.
  std::map<AllowedCollisions::Pair, bool> allowed_collisions;
  std::vector<NamedPosture> postures;  ///< Postures of robots[0] or a part of it; names are unique.
  std::filesystem::path hand_basis;    ///< PMD basis file as the scene names it; may be empty.
  PlannerRequest planner;              ///< Read by planning alone.
  std::vector<Program> programs;       ///< Names are unique.
  SceneDisplay display;                ///< Read by the window alone.
  std::vector<std::string> warnings;   ///< Warnings of the reader.
};

/// First robot or object of that name; nullptr if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const RobotInstance* find_robot(const Scene& scene,
                                                                       std::string_view name);
/// First object of that name; nullptr if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const SceneObject* find_object(const Scene& scene,
                                                                      std::string_view name);

/// First frame of that name; nullptr if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const NamedFrame* find_frame(const Scene& scene,
                                                                    std::string_view name);

/// Returns the pose in the world of an object that stands there, or of a frame of the world or of
/// such an object; nothing for anything else.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<Pose> standing_pose(const Scene& scene,
                                                                         std::string_view name);

/// Returns the names for which standing_pose() gives a pose: objects, then frames.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> standing_names(const Scene& scene);

/// The robot of that name, or with a part of that name; nullptr if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const RobotInstance* find_robot_with_part(
    const Scene& scene, std::string_view name);

/// Returns whether the object is fixed to a link of the robot.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_carried_by(const SceneObject& object,
                                                          const RobotInstance& robot);

/// Removes the objects of these names and the settings about them: display, frames, allowed
/// collisions, and constraints, unless these are about a link of the same name.
HANDWAY_GEOMETRIC_EXPORT void remove_objects(Scene& scene, const std::vector<std::string>& names);

/// Moves the goal poses of `after` with their objects and frames, as these were moved since
/// `before`. A goal whose object or frame is gone, or attached to a link, stays where it is and
/// follows none any more. Tool frames of goals become those of the frames that they name.
HANDWAY_GEOMETRIC_EXPORT void follow_objects(const Scene& before, Scene& after);

/// Names of bodies that a constraint may refer to: the objects that the first robot carries, then
/// its links.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> constrainable_bodies(
    const Scene& scene);

}  // namespace handway::geometric
