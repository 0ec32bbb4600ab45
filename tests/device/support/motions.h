#pragma once

#include "handway/device/core/trajectory_client.h"

#include <chrono>
#include <functional>

namespace handway::test {

/// Returns a motion from rest at `from` to rest `way` (rad) farther, along a cosine, in `duration`
/// s, a point every 20 ms.
[[nodiscard]] device::JointTrajectory swing(const Eigen::VectorXd& from, const Eigen::VectorXd& way,
                                            double duration);

/// Updates the link until `done` says so, at most `seconds`. @returns whether it did.
bool update_until(device::TrajectoryClient& link, const std::function<bool()>& done,
                  double seconds = 5);

/// Updates the link until its motion has ended.
void run_to_end(device::TrajectoryClient& link);

/// Waits until `done` says so, at most 3 s. @returns how long it took, s.
[[nodiscard]] double wait_until(const std::function<bool()>& done);

}  // namespace handway::test
