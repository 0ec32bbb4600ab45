#pragma once

#include "collision_matrix.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_moveit {

/// Poses of frames in the world by name: the robot's links, "world" and the scene's frames
/// (`fixed_frame_transforms`).
using Frames = std::map<std::string, geometric::Pose>;

/// A ball that contains all bodies of a robot in all configurations.
struct Reach {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< The robot's base, in the world.
  double radius = 0.0;                               ///< m
};

/// Returns the reach with all joints stretched, and as much again for what the robot carries.
[[nodiscard]] Reach reach_of(const geometric::RobotInstance& robot);

/// The frame in a message's `header`; nothing if it names none.
[[nodiscard]] std::optional<std::string> frame_name(const geometric::YamlElement& message);

/// Returns the pose in the world of the frame in a message's `header`; "world" if it names none.
/// @throws InputError if the frame is unknown.
[[nodiscard]] geometric::Pose frame_of(const geometric::YamlElement& message, const Frames& frames);

/// The `primitives` of a message with their poses, `primitive_poses`, in the message's frame.
/// @throws InputError naming the fault of a primitive.
[[nodiscard]] std::vector<std::pair<geometric::Shape, geometric::Pose>> read_primitives(
    const geometric::YamlElement& message);

/// A shape of a collision object, which a message may move in the object.
struct ObjectShape {
  geometric::Shape shape;  ///< Unused for a plane, see `plane`.
  geometric::Pose X_OS = geometric::Pose::Identity();
  /// The plane's numbers: its half space depends on where the plane is.
  std::optional<geometric::YamlElement> plane = {};
};

/// A collision object by its id, which later messages may move, extend or remove.
struct WorldObject {
  geometric::Pose X_PO = geometric::Pose::Identity();  ///< In the world, or in the link.
  std::vector<ObjectShape> shapes = {};                ///< In the order of World::names.
  Frames subframes = {};                               ///< Poses of its subframes in it.
};

/// Frames that move with links: of attached objects and their subframes, by their names.
struct HeldFrame {
  std::string link;
  geometric::Pose X_LF = geometric::Pose::Identity();
};
using HeldFrames = std::map<std::string, HeldFrame>;

/// World into which objects are read.
struct World {
  const Frames& frames;
  std::filesystem::path folder;  ///< Problem's folder, for meshes.
  Reach reach;                   ///< Size of drawn planes.
  geometric::Scene& scene;
  ObjectNames names = {};                           ///< Names of the objects added so far.
  std::map<std::string, WorldObject> objects = {};  ///< By their ids.
};

/// Adds the collision objects of `message` (moveit_msgs/PlanningSceneWorld): an object of the scene
/// for each primitive, mesh and plane. Each message is applied by its `operation`, in their order:
/// ADD replaces an object of the same id, APPEND gives it more shapes, MOVE moves it unless it is
/// attached, and REMOVE removes it, or all without an id. Headers may name objects that are there
/// already, and their subframes, as "OBJECT/SUBFRAME". A plane is the half space opposite to the
/// robot's base, up to the ends of the reach; if the base is on it, the one below. An octomap is
/// one mesh (octomap_mesh()), "<octomap>" for the collision matrix.
/// @throws InputError for anything that can't be read.
void add_world(const geometric::YamlElement& message, World& world);

/// Adds objects attached to the first robot (moveit_msgs/AttachedCollisionObject), by their
/// operation: ADD without shapes attaches an object of the world, REMOVE detaches it.
/// @throws InputError as add_world().
void add_attached(const geometric::YamlElement& attached, World& world);

/// Returns all frames of a world: also its objects that no link carries, and their subframes.
[[nodiscard]] Frames frames_of(const World& world);

/// Returns the frames of a world's attached objects and of their subframes.
[[nodiscard]] HeldFrames held_frames_of(const World& world);

/// Removes all attached objects. @returns whether there were any.
bool remove_attached(World& world);

}  // namespace handway::import_moveit
