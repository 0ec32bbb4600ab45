#pragma once

#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <string>
#include <string_view>

/// Pieces of YAML text.
namespace handway::geometric {

/// `text` plain if YAML reads it back unchanged, in double quotes otherwise; valid in block and
/// flow style.
[[nodiscard]] std::string yaml_scalar(std::string_view text);

/// "[1, 2.5, 3]".
[[nodiscard]] std::string yaml_list(const Eigen::VectorXd& numbers);

/// For files: rounded to 1e-12 degrees.
[[nodiscard]] double rounded_degrees(double radians);

/// "{xyz: […], rpy_deg: […]}"; angles rounded to 1e-12 degrees.
[[nodiscard]] std::string yaml_pose(const Pose& X);

}  // namespace handway::geometric
