#include "support/motions.h"

#include <cmath>
#include <numbers>
#include <thread>

namespace handway::test {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

device::JointTrajectory swing(const Eigen::VectorXd& from, const Eigen::VectorXd& way,
                              double duration) {
  const auto steps = static_cast<Eigen::Index>(std::ceil(duration / 0.02));
  device::JointTrajectory trajectory;
  trajectory.positions.resize(steps + 1, from.size());
  for (Eigen::Index i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    trajectory.times.push_back(share * duration);
    trajectory.positions.row(i) = from + 0.5 * (1.0 - std::cos(std::numbers::pi * share)) * way;
  }
  return trajectory;
}

bool update_until(device::TrajectoryClient& link, const std::function<bool()>& done,
                  double seconds) {
  const auto begin = Clock::now();
  while (!done()) {
    if (since(begin) > seconds) {
      return false;
    }
    link.update();
  }
  return true;
}

void run_to_end(device::TrajectoryClient& link) {
  update_until(
      link,
      [&] {
        return link.phase() != device::MotionPhase::kRunning &&
               link.phase() != device::MotionPhase::kPaused;
      },
      20.0);
}

double wait_until(const std::function<bool()>& done) {
  const auto begin = Clock::now();
  while (!done() && since(begin) < 3.0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return since(begin);
}

}  // namespace handway::test
