#pragma once

#include "handway/geometric/formats/yaml_element.h"

#include <filesystem>
#include <optional>

namespace handway::import_moveit {

/// The files of a problem in MotionBenchMaker's layout: `scene0001.yaml` beside
/// `request0001.yaml`.
struct ProblemFiles {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> request;  ///< Empty: a scene without a query.
};

/// Returns whether the file begins like a moveit_msgs/PlanningScene or MotionPlanRequest, and not
/// like a scene of Handway. Reads its first 64 KiB.
[[nodiscard]] bool is_moveit_file(const std::filesystem::path& file);

/// Returns the problem of `file`, a scene or a request.
/// @throws InputError if a request has no scene beside it.
[[nodiscard]] ProblemFiles problem_files(const std::filesystem::path& file);

/// The URDF of a robot: $HANDWAY_ROBOT (`--robot`); else `NAME.urdf` or `NAME/NAME.urdf`,
/// `robots/NAME.urdf` or `robots/NAME/NAME.urdf` in the problem's folder or one of the three above
/// it, or a robot that ships. Its SRDF lies beside it.
/// @param name the element `robot_model_name` of the scene.
/// @throws InputError if it does not exist.
[[nodiscard]] std::filesystem::path robot_file(const geometric::YamlElement& name,
                                               const std::filesystem::path& folder);

/// The file of a mesh `resource`: a path, `file://…`, or `package://PACKAGE/…`, which is searched,
/// with and without the package's name, in the problem's folder and the three above it, and in the
/// places of find_package().
/// @throws InputError if it does not exist.
[[nodiscard]] std::filesystem::path mesh_file(const geometric::YamlElement& resource,
                                              const std::filesystem::path& folder);

}  // namespace handway::import_moveit
