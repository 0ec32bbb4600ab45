#include "handway/device/haptic/haptic_device.h"

#include "handway/device/core/device_error.h"

#include <fmt/format.h>

#include <exception>

namespace handway::device {
namespace {

constexpr std::chrono::milliseconds kLongestSilence{100};

}  // namespace

void HapticDevice::refuse(std::string found, std::string expected, std::string advice) const {
  throw DeviceError({name_, "", std::move(found), std::move(expected), std::move(advice)});
}

void HapticDevice::connect(const std::stop_token& stop) {
  abilities_ = do_connect(stop);
  silence_.heard(Silence::Clock::now());
  backlog_ = {};
}

std::optional<HapticSample> HapticDevice::read(std::chrono::milliseconds timeout) {
  try {
    const Reading reading = do_read(timeout);
    const auto now = Silence::Clock::now();
    backlog_.turn(reading.all, now);
    if (backlog_.lasted(now) > kLongestSilence) {
      refuse(fmt::format("more messages than can be read, for {} ms", kLongestSilence.count()),
             "a position every 10 ms or more often",
             "What it says is old by the time it is read: look at its program.");
    }
    if (reading.newest) {
      silence_.heard(now);
    } else if (silence_.listened(now) > kLongestSilence) {
      refuse(fmt::format("no position for {} ms", kLongestSilence.count()),
             "one every 10 ms or more often", "Look at the network and at the device.");
    }
    return reading.newest;
  } catch (...) {
    release();
    throw;
  }
}

void HapticDevice::apply(const Eigen::Vector3d& force) {
  const double strength = force.norm();
  if (!force.allFinite()) {
    do_apply(Eigen::Vector3d::Zero());
  } else if (strength > abilities_.force) {
    do_apply(force * (abilities_.force / strength));
  } else {
    do_apply(force);
  }
}

void HapticDevice::release() {
  try {
    do_apply(Eigen::Vector3d::Zero());
  } catch (const std::exception&) {
    // The connection is gone: the device's own watchdog lets go.
    return;
  }
}

}  // namespace handway::device
