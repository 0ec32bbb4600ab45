#pragma once

#include "handway/geometric/io/yaml_element.h"

#include <filesystem>
#include <optional>
#include <string>

namespace handway::import_moveit {

/// The files of a problem as MotionBenchMaker lays them out: `scene0001.yaml` beside
/// `request0001.yaml`.
struct ProblemFiles {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> request;  ///< Nothing: a scene without a query.
};

/// Does the file begin like a moveit_msgs/PlanningScene or MotionPlanRequest, and not like
/// one of Handway's own? Looks at its first 64 KiB.
[[nodiscard]] bool is_moveit_file(const std::filesystem::path& file);

/// The problem that `file`, a scene or a request, belongs to.
/// @throws InputError if a request has no scene beside it.
[[nodiscard]] ProblemFiles problem_files(const std::filesystem::path& file);

/// The URDF of a robot: `NAME.urdf` or `NAME/NAME.urdf`, `robots/NAME.urdf` or
/// `robots/NAME/NAME.urdf` in the problem's folder or one of the three above it, or a robot
/// that ships. Its SRDF lies beside it.
/// @param name the element `robot_model_name` of the scene.
/// @throws InputError if there is none.
[[nodiscard]] std::filesystem::path robot_file(const geometric::YamlElement& name,
                                               const std::filesystem::path& folder);

/// The file of a mesh `resource`: a path, `file://…`, or `package://PACKAGE/…`, which is looked
/// for, with and without the package's name, in the problem's folder and the three above it.
/// @throws InputError if there is none.
[[nodiscard]] std::filesystem::path mesh_file(const geometric::YamlElement& resource,
                                              const std::filesystem::path& folder);

}  // namespace handway::import_moveit
