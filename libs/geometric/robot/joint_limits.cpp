#include "handway/geometric/robot/robot_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace handway::geometric {

void narrow_limits(RobotDescription& robot, Joint& joint, std::optional<double> lower,
                   std::optional<double> upper, const std::string& source) {
  JointLimits narrowed = joint.limits;
  narrowed.lower = std::max(narrowed.lower, lower.value_or(narrowed.lower));
  narrowed.upper = std::min(narrowed.upper, upper.value_or(narrowed.upper));
  const bool has_both_ends = std::isfinite(narrowed.lower) == std::isfinite(narrowed.upper);
  if (has_both_ends &&
      (narrowed.lower < narrowed.upper ||
       (narrowed.lower == joint.limits.lower && narrowed.upper == joint.limits.upper))) {
    joint.limits = narrowed;
    return;
  }
  robot.warnings.push_back(
      fmt::format("joint {}: limits {} to {} of {} are not kept: {}", joint.name,
                  lower ? fmt::format("{:g}", *lower) : "(none)",
                  upper ? fmt::format("{:g}", *upper) : "(none)", source,
                  has_both_ends ? "they leave it no range" : "it has no end on the other side"));
}

}  // namespace handway::geometric
