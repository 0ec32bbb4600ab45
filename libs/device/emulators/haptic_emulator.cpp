#include "handway/device/emulators/haptic_emulator.h"

#include "emulators/emulator_thread.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr double kStep = 5e-4;  // s, of the integration
// Speed of the hand that returns the handle, m/s, and distance that counts as returned, m.
constexpr double kReturnSpeed = 0.25;
constexpr double kReturned = 0.002;
// Share of each half edge of the workspace that the hand uses.
constexpr double kEdge = 0.9;
// Rest after which the hand presses again: duration, s, and speed, m/s.
constexpr double kRest = 0.8;
constexpr double kRestSpeed = 0.004;
// Rate of the tremor's rotation, rad/s, about each axis.
const Eigen::Vector3d kTrembling(7.0, 9.1, 11.7);

}  // namespace

EmulatedHaptic::EmulatedHaptic(const EmulatedHapticSettings& settings) : settings_(settings) {
  if (!(settings.mass > 0.0) || !(settings.friction > 0.0) || !(settings.tremble >= 0.0) ||
      !(settings.abilities.force > 0.0) || !(settings.abilities.workspace.array() > 0.0).all()) {
    throw std::invalid_argument("a haptic device needs mass, friction, force and workspace");
  }
}

const char* EmulatedHaptic::fault_text() const {
  if (!fault_active_) {
    return nullptr;
  }
  switch (settings_.fault.kind) {
    case FaultKind::kRefused:
      return "the motors are too warm";
    case FaultKind::kEstop:
      return "emergency stop";
    default:
      return nullptr;
  }
}

void EmulatedHaptic::step() {
  now_ += kStep;
  sample_.time = now_;
  if (now_ - forced_ > kHapticLongestSilence || fault_text() != nullptr) {
    force_.setZero();
  }
  if (!greeted_) {
    sample_.velocity.setZero();
    sample_.button = false;
    return;
  }
  if (sample_.button) {
    move_hand();
  } else {
    bring_back();
  }
  if (has_guided_) {
    guided_ += kStep;
    fault_active_ = fault_active_ ||
                    (settings_.fault.kind != FaultKind::kNone && guided_ >= settings_.fault.after);
  }
}

void EmulatedHaptic::move_hand() {
  const Eigen::Vector3d tremble = settings_.tremble * (now_ * kTrembling).array().sin();
  sample_.velocity +=
      kStep / settings_.mass * (force_ + tremble - settings_.friction * sample_.velocity);
  sample_.position += kStep * sample_.velocity;
  resting_ = sample_.velocity.norm() < kRestSpeed ? resting_ + kStep : 0.0;
  const bool at_edge =
      (sample_.position.array().abs() > kEdge * settings_.abilities.workspace.array()).any();
  if (at_edge || resting_ > kRest) {
    sample_.button = false;
    resting_ = 0.0;
  }
}

void EmulatedHaptic::bring_back() {
  const double away = sample_.position.norm();
  if (away < kReturned) {
    sample_.velocity.setZero();
    sample_.button = true;
    return;
  }
  sample_.velocity = -sample_.position / away * kReturnSpeed;
  sample_.position += kStep * sample_.velocity;
}

std::string EmulatedHaptic::obey(const std::string& line) {
  if (line.starts_with("hello")) {
    if (line != fmt::format("hello {}", kHapticProtocolVersion)) {
      return fmt::format("fault this device speaks version {}\n", kHapticProtocolVersion);
    }
    greeted_ = true;
    return hello_line(settings_.abilities);
  }
  const Eigen::Vector3d wanted = parse_haptic_force(line);
  const double strength = wanted.norm();
  force_ = wanted * std::min(1.0, settings_.abilities.force / std::max(strength, 1e-12));
  forced_ = now_;
  has_guided_ = true;
  return "";
}

std::string EmulatedHaptic::receive(const std::string& line, double now) {
  advance(now);
  try {
    return obey(line);
  } catch (const LineProtocolError& error) {
    return fmt::format("fault {}\n", error.what());
  }
}

void EmulatedHaptic::advance(double now) {
  while (now_ + kStep <= now) {
    step();
  }
}

std::string EmulatedHaptic::feedback() const {
  if (!greeted_) {
    return "";
  }
  const char* fault = fault_text();
  return fault != nullptr ? fmt::format("fault {}\n", fault) : state_line(sample_);
}

void EmulatedHaptic::connection_lost() {
  greeted_ = false;
  force_.setZero();
}

namespace {

constexpr double kStatePeriod = 0.002;  // s

}  // namespace

struct HapticEmulator::Running : EmulatorThread<EmulatedHaptic, LinePort> {
  using EmulatorThread::EmulatorThread;
};

HapticEmulator::HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(kStatePeriod, settings, std::string("haptic"), port)) {}

HapticEmulator::~HapticEmulator() = default;

const std::string& HapticEmulator::address() const { return running_->address(); }

Eigen::Vector3d HapticEmulator::force() const {
  return running_->ask([](const EmulatedHaptic& device) { return device.force(); });
}

}  // namespace handway::device
