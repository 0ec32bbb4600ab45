#pragma once

#include "motion_log.h"
#include "send_targets.h"

#include <stop_token>
#include <string>
#include <vector>

namespace handway::tools {

/// How a motion on devices ended.
struct SendOutcome {
  bool done = false;          ///< To its end.
  std::string fault;          ///< Why not; empty if it was asked to stop.
  double time = 0.0;          ///< s of the motion at the end.
  double stop_sent_ms = 0.0;  ///< From the request at most until all devices were told to stop.
  double at_rest_ms = -1.0;   ///< From there until all were measured at rest; -1: not seen.
  std::vector<FollowingError> errors;  ///< Of each target.
};

/// Runs the motions that were uploaded to the targets together, from start to rest. What ends one
/// ends all: a fault, or `stop`. Prints progress.
/// @throws DeviceError if one can't start; none moves then.
[[nodiscard]] SendOutcome run_motion(std::vector<SendTarget>& targets,
                                     const device::MotionTolerances& tolerances, MotionLog& log,
                                     const std::stop_token& stop);

}  // namespace handway::tools
