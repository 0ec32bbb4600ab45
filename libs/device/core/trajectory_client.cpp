#include "handway/device/core/trajectory_client.h"

#include "handway/device/core/device_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace handway::device {
namespace {

using std::chrono::milliseconds;

// Devices report their positions every 10 or 20 ms.
constexpr milliseconds kLongestSilence{250};
constexpr milliseconds kFirstPosition{3000};
// Longest time for reading pending messages: megabytes, from a working device.
constexpr milliseconds kLongestBacklog{500};
// Longest time that a motion may arrive late, s.
constexpr double kLatestArrival = 2.0;

double seconds(TrajectoryClient::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Eigen::VectorXd MotionTolerances::distances(const Eigen::VectorXd& measured,
                                            const Eigen::VectorXd& target) const {
  const Eigen::VectorXd away = (measured - target).cwiseAbs();
  return give.size() == 0 ? away : (away - give).cwiseMax(0.0);
}

std::vector<geometric::BoundParameter> parameters_of(MotionTolerances& tolerances) {
  const geometric::BoundParameter start{"start_tolerance",
                                        "Start tolerance",
                                        "rad",
                                        "Largest distance of a joint from the motion's start",
                                        &tolerances.start,
                                        1e-5,
                                        1.0};
  const geometric::BoundParameter following{"following_tolerance",
                                            "Following tolerance",
                                            "rad",
                                            "Largest following error of a joint during a motion",
                                            &tolerances.following,
                                            1e-5,
                                            1.0};
  return {start, following};
}

TrajectoryClient::TrajectoryClient(std::string name, JointRanges joints)
    : name_(std::move(name)), joints_(std::move(joints)) {
  const Eigen::Index count = joints_.count();
  if (count == 0 || joints_.upper.size() != count || joints_.velocity.size() != count ||
      std::cmp_not_equal(joints_.names.size(), count) ||
      !(joints_.lower.array() <= joints_.upper.array()).all() ||
      !(joints_.velocity.array() > 0.0).all()) {
    throw std::invalid_argument("joints of a device without ranges or velocities");
  }
}

void TrajectoryClient::refuse(std::string found, std::string expected, std::string advice) const {
  throw DeviceError({name_, "", std::move(found), std::move(expected), std::move(advice)});
}

void TrajectoryClient::connect(const std::stop_token& stop) {
  connected_ = false;
  phase_ = MotionPhase::kIdle;
  measured_ = {};
  backlog_ = {};
  do_connect(stop);
  const auto begin = Clock::now();
  while (measured_.samples == 0 || backlog_.any()) {
    if (Clock::now() - begin > kFirstPosition || stop.stop_requested()) {
      refuse("no joint positions", "a controller that reports where its joints are",
             "Look whether its program is running.");
    }
    take_turn(0.0);
    std::this_thread::sleep_for(milliseconds(1));
  }
  watchdog_.heard(Clock::now());
  connected_ = true;
}

// Reads one bounded piece of the device's messages.
void TrajectoryClient::take_turn(double time) {
  const bool all = do_update(time);
  const auto now = Clock::now();
  backlog_.turn(all, now);
  if (backlog_.lasted(now) > kLongestBacklog) {
    refuse(fmt::format("more messages than can be read, for {} ms", kLongestBacklog.count()),
           "joint positions every 10 or 20 ms",
           "What it says is old by the time it is read: look at its program.");
  }
}

void TrajectoryClient::upload(const JointTrajectory& trajectory, const std::stop_token& stop) {
  if (!connected_) {
    refuse("no connection", "one that is made", "Connect again.");
  }
  if (phase_ == MotionPhase::kRunning || phase_ == MotionPhase::kPaused) {
    refuse("a motion under way", "a device at rest", "Stop it first.");
  }
  check_trajectory(trajectory, joints_);
  // Reads all pending messages, so that the position is the present one.
  do {
    take_turn(0.0);
  } while (backlog_.any() && !stop.stop_requested());
  do_upload(trajectory, stop);
  trajectory_ = trajectory;
  phase_ = MotionPhase::kReady;
  fault_.clear();
}

void TrajectoryClient::start(const MotionTolerances& tolerances) {
  update();
  if (phase_ != MotionPhase::kReady) {
    refuse(fault_.empty() ? "no motion" : fault_, "a motion that is uploaded", "Upload one.");
  }
  const Eigen::VectorXd away =
      tolerances.distances(measured_.position, trajectory_.positions.row(0));
  for (Eigen::Index j = 0; j < joints_.count(); ++j) {
    if (away[j] > tolerances.start) {
      refuse(fmt::format("joint {} at {:.4f} rad", joints_.names[static_cast<std::size_t>(j)],
                         measured_.position[j]),
             fmt::format("{:.4f} rad within {:.4f}", trajectory_.positions(0, j), tolerances.start),
             "Move the device to the start, or plan from where it stands.");
    }
  }
  try {
    do_start();
  } catch (...) {
    // The device may have received the start before it failed.
    (void)send_stop();
    throw;
  }
  tolerances_ = tolerances;
  begin_ = Clock::now();
  samples_seen_ = measured_.samples;
  phase_ = MotionPhase::kRunning;
}

double TrajectoryClient::pause(double time) {
  if (phase_ == MotionPhase::kRunning) {
    try {
      hold_ = do_pause(std::max(time, motion_time(Clock::now())));
      phase_ = MotionPhase::kPaused;
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }
  return phase_ == MotionPhase::kPaused ? hold_ : motion_time(Clock::now());
}

void TrajectoryClient::resume() {
  if (phase_ == MotionPhase::kPaused) {
    const auto now = Clock::now();
    const double held = motion_time(now);
    try {
      do_resume();
    } catch (const std::exception& error) {
      fail(error.what());
      return;
    }
    begin_ = now - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(held));
    samples_seen_ = measured_.samples;
    phase_ = MotionPhase::kRunning;
  }
}

void TrajectoryClient::stop() {
  const bool moving = phase_ == MotionPhase::kRunning || phase_ == MotionPhase::kPaused;
  try {
    if (connected_) {
      do_stop();
    }
  } catch (const std::exception& error) {
    if (moving) {
      fail(error.what());
    }
    return;
  }
  if (moving || phase_ == MotionPhase::kReady) {
    phase_ = MotionPhase::kStopped;
  }
}

double TrajectoryClient::motion_time(Clock::time_point now) const {
  switch (phase_) {
    case MotionPhase::kIdle:
    case MotionPhase::kReady:
      return 0.0;
    case MotionPhase::kPaused:
      return std::min(hold_, seconds(now - begin_));
    default:
      return seconds(now - begin_);
  }
}

void TrajectoryClient::fail(std::string fault) {
  fault_ = std::move(fault);
  phase_ = MotionPhase::kFailed;
  connected_ = send_stop();
}

// @returns false if the connection is gone: the device's own watchdog stops it then.
bool TrajectoryClient::send_stop() {
  try {
    do_stop();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void TrajectoryClient::update() {
  if (!connected_) {
    return;
  }
  try {
    take_turn(motion_time(Clock::now()));
    if (watchdog_.listened(Clock::now()) > kLongestSilence) {
      refuse(fmt::format("no joint positions for {} ms", kLongestSilence.count()),
             "one every 20 ms or more often", "Look at the network and at the controller.");
    }
    if (phase_ == MotionPhase::kRunning) {
      look_at_sample();
      look_at_end(Clock::now());
    }
  } catch (const std::exception& error) {
    if (phase_ == MotionPhase::kFailed) {
      connected_ = false;
    } else {
      fail(error.what());
    }
  }
}

void TrajectoryClient::look_at_sample() {
  if (measured_.samples == samples_seen_) {
    return;
  }
  samples_seen_ = measured_.samples;
  const Eigen::VectorXd planned = trajectory_.at(motion_time(measured_.received));
  const Eigen::VectorXd errors = tolerances_.distances(measured_.position, planned);
  for (Eigen::Index j = 0; j < joints_.count(); ++j) {
    if (errors[j] > tolerances_.following) {
      refuse(fmt::format("joint {} at {:.4f} rad", joints_.names[static_cast<std::size_t>(j)],
                         measured_.position[j]),
             fmt::format("{:.4f} rad within {:.4f}", planned[j], tolerances_.following),
             "The device does not follow: look whether it runs at full monitor speed and nothing "
             "is in its way, or move slower.");
    }
  }
}

void TrajectoryClient::look_at_end(Clock::time_point now) {
  const double late = motion_time(now) - trajectory_.duration();
  if (late < 0.0) {
    return;
  }
  const Eigen::VectorXd end = trajectory_.at(trajectory_.duration());
  const double away = tolerances_.distances(measured_.position, end).maxCoeff();
  if (away <= tolerances_.end &&
      measured_.received - begin_ > std::chrono::duration<double>(trajectory_.duration())) {
    phase_ = MotionPhase::kDone;
  } else if (late > kLatestArrival) {
    refuse(fmt::format("{:.4f} rad away from the last point {} s after its time", away,
                       kLatestArrival),
           fmt::format("{:.4f} rad or less", tolerances_.end),
           "The device did not run the whole motion.");
  }
}

void TrajectoryClient::add_sample(const Eigen::VectorXd& position) {
  measured_.position = position;
  measured_.received = Clock::now();
  ++measured_.samples;
  watchdog_.heard(measured_.received);
}

}  // namespace handway::device
