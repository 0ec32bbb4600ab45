#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {

/// Returns `model`, with a moving root if the robot has "moving_base", and slides of its bases
/// within the robot's "bounds".
/// @throws InputError naming the line.
[[nodiscard]] std::shared_ptr<const RobotModel> with_bases(
    const YamlElement& robot, const std::shared_ptr<const RobotModel>& model);

/// Sets bounds of base slides missing in the robot's "bounds": the box around objects, robots,
/// start, goal and goal poses, larger by kAroundScene each way.
/// @param robots the elements of the scene's robots, with their bounds.
void bound_bases(const std::vector<YamlElement>& robots, Scene& scene);

/// A scene file's `goal_pose`: one goal, or a list of them.
/// @param scene has the robots and objects that they name.
[[nodiscard]] std::vector<PoseGoal> pose_goals_of(const YamlElement& element, const Scene& scene);

/// Reads a pose of a link. @returns a goal whose X_WG is in the frame of its reference.
/// @param warnings receives references and tools that the scene does not have; nullptr: they are
/// errors.
[[nodiscard]] PoseGoal relative_goal_of(const YamlElement& element, const Scene& scene,
                                        std::vector<std::string>* warnings);

/// Returns the entries of a goal's map, such as "link: palm".
/// @param X its pose in the frame of its reference.
[[nodiscard]] std::vector<std::string> goal_entries(const PoseGoal& goal, const Pose& X);

/// Reads the name of an object or frame that stands in the world.
/// @param warnings as for relative_goal_of().
[[nodiscard]] std::string standing_name_of(const YamlElement& element, const Scene& scene,
                                           std::vector<std::string>* warnings);

/// Reads one entry of a scene file's `frames`.
/// @param scene with the robots and objects to which the frame may be fixed.
[[nodiscard]] NamedFrame frame_of(const YamlElement& element, const Scene& scene);

/// Returns the frames as text; empty without frames.
[[nodiscard]] std::string frames_text(const std::vector<NamedFrame>& frames);

/// Returns the scene's goal poses as text; empty without goals.
[[nodiscard]] std::string pose_goals_text(const Scene& scene);

/// A scene file's `program`: a list of steps, or a map from names to such lists. Adds a warning for
/// each object that the scene does not have.
[[nodiscard]] std::vector<Program> programs_of(const YamlElement& element, Scene& scene);

/// Returns the programs as text; empty without programs.
[[nodiscard]] std::string programs_text(const std::vector<Program>& programs);

/// `{xyz: […], rpy_deg: […]}`, both optional.
[[nodiscard]] Pose pose_of(const YamlElement& element);

/// Calls find_resource(), and warns if the file's name differs in case from the scene's.
[[nodiscard]] std::filesystem::path find_noted(ResourceKind kind, const YamlElement& reference,
                                               const std::filesystem::path& folder, Scene& scene);

/// The object that an element names. @throws InputError if the scene has none of that name.
[[nodiscard]] const SceneObject& named_object_of(const YamlElement& element, const Scene& scene);

/// One entry of a scene file's `objects`.
/// @param scene with its robots, to which the object may be attached; warnings are added to it.
/// @param folder of the scene file.
[[nodiscard]] SceneObject object_of(const YamlElement& element, Scene& scene,
                                    const std::filesystem::path& folder);

/// Reads the display settings from the entry of an object.
[[nodiscard]] ObjectDisplay display_of(const YamlElement& element);

/// Reads the list `robots` of a scene file, and mounts robots on each other.
/// @param folder of the scene file.
/// @returns the elements of the robots that are fixed to the world, in the order of scene.robots:
/// that of the list, with a carrier in the place of the robot that it carries.
/// @throws InputError naming the line.
[[nodiscard]] std::vector<YamlElement> read_robots(const YamlElement& list,
                                                   const std::filesystem::path& folder,
                                                   Scene& scene);

/// A map of joint names to values (rad, m), laid over `defaults`. A coupled joint may be
/// named too: it then determines its leader's value, or must agree with it (within
/// 1e-6).
/// @param defaults shape [variable_count].
/// @param part of a composed robot: its joints may have their own names; nullptr: none may.
/// @throws InputError naming the line, for unknown and fixed joints and for
/// coupled joints that contradict each other.
[[nodiscard]] Configuration configuration_of(const YamlElement& element, const RobotModel& model,
                                             const Configuration& defaults,
                                             const RobotPart* part = nullptr);

/// Returns the child link of the named joint. @throws InputError if it is missing or fixed.
[[nodiscard]] int carried_link(const YamlElement& element, const RobotModel& model,
                               const std::string& name);

/// @throws InputError, always: names of robots and objects must be unique.
[[noreturn]] void refuse_second_name(const YamlElement& element, const std::string& name);

}  // namespace handway::geometric
