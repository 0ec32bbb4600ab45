#include "handway/device/haptic/haptic_emulator.h"

#include "core/line_emulator.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr double kStep = 5e-4;  // s, of the integration
// Of the hand that brings the handle back, m/s and m.
constexpr double kReturnSpeed = 0.25;
constexpr double kReturned = 0.002;
// A share of the workspace, of each half edge, that it uses.
constexpr double kEdge = 0.9;
// A hand at rest for so long, s, slower than that, m/s, presses again.
constexpr double kRest = 0.8;
constexpr double kRestSpeed = 0.004;
// How fast the tremble turns, rad/s, about each axis.
const Eigen::Vector3d kTrembling(7.0, 9.1, 11.7);

}  // namespace

struct EmulatedHaptic::Device {
  explicit Device(const EmulatedHapticSettings& given) : settings(given) {
    if (!(given.mass > 0.0) || !(given.friction > 0.0) || !(given.tremble >= 0.0) ||
        !(given.abilities.force > 0.0) || !(given.abilities.workspace.array() > 0.0).all()) {
      throw std::invalid_argument("a haptic device needs mass, friction, force and workspace");
    }
  }

  EmulatedHapticSettings settings;
  HapticSample sample;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double now = 0.0;
  double forced = 0.0;   ///< When the last force came.
  double resting = 0.0;  ///< s
  double guided = 0.0;   ///< s since the first force.
  bool greeted = false;
  bool has_guided = false;
  bool fault_active = false;

  void step();
  void move_hand();
  void bring_back();
  [[nodiscard]] std::string obey(const std::string& line);
  [[nodiscard]] const char* fault_text() const;
};

const char* EmulatedHaptic::Device::fault_text() const {
  if (!fault_active) {
    return nullptr;
  }
  switch (settings.fault.kind) {
    case FaultKind::kRefused:
      return "the motors are too warm";
    case FaultKind::kEstop:
      return "emergency stop";
    default:
      return nullptr;
  }
}

void EmulatedHaptic::Device::step() {
  now += kStep;
  sample.time = now;
  if (now - forced > kHapticLongestSilence || fault_text() != nullptr) {
    force.setZero();
  }
  if (!greeted) {
    sample.velocity.setZero();
    sample.button = false;
    return;
  }
  if (sample.button) {
    move_hand();
  } else {
    bring_back();
  }
  if (has_guided) {
    guided += kStep;
    fault_active =
        fault_active || (settings.fault.kind != FaultKind::kNone && guided >= settings.fault.after);
  }
}

void EmulatedHaptic::Device::move_hand() {
  const Eigen::Vector3d tremble = settings.tremble * (now * kTrembling).array().sin();
  sample.velocity +=
      kStep / settings.mass * (force + tremble - settings.friction * sample.velocity);
  sample.position += kStep * sample.velocity;
  resting = sample.velocity.norm() < kRestSpeed ? resting + kStep : 0.0;
  const bool at_edge =
      (sample.position.array().abs() > kEdge * settings.abilities.workspace.array()).any();
  if (at_edge || resting > kRest) {
    sample.button = false;
    resting = 0.0;
  }
}

void EmulatedHaptic::Device::bring_back() {
  const double away = sample.position.norm();
  if (away < kReturned) {
    sample.velocity.setZero();
    sample.button = true;
    return;
  }
  sample.velocity = -sample.position / away * kReturnSpeed;
  sample.position += kStep * sample.velocity;
}

std::string EmulatedHaptic::Device::obey(const std::string& line) {
  if (line.starts_with("hello")) {
    if (line != fmt::format("hello {}", kHapticProtocolVersion)) {
      return fmt::format("fault this device speaks version {}\n", kHapticProtocolVersion);
    }
    greeted = true;
    return hello_line(settings.abilities);
  }
  const Eigen::Vector3d wanted = parse_haptic_force(line);
  const double strength = wanted.norm();
  force = wanted * std::min(1.0, settings.abilities.force / std::max(strength, 1e-12));
  forced = now;
  has_guided = true;
  return "";
}

EmulatedHaptic::EmulatedHaptic(const EmulatedHapticSettings& settings)
    : device_(std::make_unique<Device>(settings)) {}

EmulatedHaptic::~EmulatedHaptic() = default;

std::string EmulatedHaptic::receive(const std::string& line, double now) {
  advance(now);
  try {
    return device_->obey(line);
  } catch (const LineProtocolError& error) {
    return fmt::format("fault {}\n", error.what());
  }
}

void EmulatedHaptic::advance(double now) {
  while (device_->now + kStep <= now) {
    device_->step();
  }
}

std::string EmulatedHaptic::feedback() const {
  if (!device_->greeted) {
    return "";
  }
  const char* fault = device_->fault_text();
  return fault != nullptr ? fmt::format("fault {}\n", fault) : state_line(device_->sample);
}

void EmulatedHaptic::connection_lost() {
  device_->greeted = false;
  device_->force.setZero();
}

const Eigen::Vector3d& EmulatedHaptic::force() const { return device_->force; }

const HapticSample& EmulatedHaptic::sample() const { return device_->sample; }

FaultKind EmulatedHaptic::active_fault() const {
  return device_->fault_active ? device_->settings.fault.kind : FaultKind::kNone;
}

namespace {

constexpr double kStatePeriod = 0.002;  // s

}  // namespace

struct HapticEmulator::Running : LineEmulator<EmulatedHaptic> {
  using LineEmulator::LineEmulator;
};

HapticEmulator::HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>("haptic", port, kStatePeriod, settings)) {}

HapticEmulator::~HapticEmulator() = default;

const std::string& HapticEmulator::address() const { return running_->address(); }

Eigen::Vector3d HapticEmulator::force() const {
  return running_->ask([](const EmulatedHaptic& device) { return device.force(); });
}

}  // namespace handway::device
