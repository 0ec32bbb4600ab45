#include "handway/device/arm/arm_emulator.h"

#include "core/delayed_bytes.h"
#include "core/host_watch.h"
#include "core/tcp_host_port.h"
#include "handway/device/core/device_error.h"

#include <array>
#include <chrono>
#include <mutex>
#include <thread>

namespace handway::device {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

constexpr double kFeedbackPeriod = 0.02;  // s
constexpr microseconds kTick{1000};
constexpr int kStatePortOffset = 2;
constexpr int kPortAttempts = 50;

struct Ports {
  std::unique_ptr<TcpHostPort> motion;
  std::unique_ptr<TcpHostPort> state;
};

Ports open_ports(std::uint16_t port) {
  for (int attempt = 1;; ++attempt) {
    Ports ports;
    ports.motion = std::make_unique<TcpHostPort>(port);
    const int state = ports.motion->port() + kStatePortOffset;
    try {
      ports.state = std::make_unique<TcpHostPort>(static_cast<std::uint16_t>(state));
      return ports;
    } catch (const DeviceError&) {
      if (port != 0 || attempt == kPortAttempts) {
        throw;
      }
    }
  }
}

}  // namespace

struct ArmEmulator::Running {
  Running(const Val3ControllerSettings& settings, std::uint16_t port)
      : controller(settings),
        ports(open_ports(port)),
        address("arm://" + ports.motion->address()) {}

  mutable std::mutex mutex;  ///< Of the controller.
  Val3Controller controller;
  Ports ports;
  std::string address;
  SimpleMessageParser parser;
  DelayedBytes replies;
  DelayedBytes feedback;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void take(std::span<const std::uint8_t> bytes, double now);
  [[nodiscard]] double delay() const {
    return controller.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void ArmEmulator::Running::take(std::span<const std::uint8_t> bytes, double now) {
  parser.add(bytes);
  try {
    while (const auto message = parser.next()) {
      replies.add(encode(controller.receive(*message, now)), now + delay());
    }
  } catch (const SimpleMessageError&) {
    ports.motion->disconnect();
  }
}

void ArmEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  HostWatch motion(*ports.motion);
  HostWatch state(*ports.state);
  double last_feedback = 0.0;
  bool cut = false;
  std::array<std::uint8_t, 4096> bytes{};
  while (!stop.stop_requested()) {
    const std::size_t count = ports.motion->read(bytes, kTick);
    std::array<std::uint8_t, 64> ignored{};
    ports.state->read(ignored, microseconds(0));
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    controller.advance(now);
    const bool motion_lost = motion.lost();
    if (motion_lost) {
      parser = {};
      replies.clear();
    }
    const bool state_lost = state.lost();
    if (motion_lost || state_lost) {
      controller.connection_lost();
    }
    take(std::span(bytes).first(count), now);
    if (now - last_feedback >= kFeedbackPeriod) {
      last_feedback = now;
      for (const SimpleMessage& message : controller.feedback()) {
        feedback.add(encode(message), now + delay());
      }
    }
    if (controller.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      ports.motion->disconnect();
      ports.state->disconnect();
    }
    replies.send(*ports.motion, now);
    feedback.send(*ports.state, now);
  }
}

ArmEmulator::ArmEmulator(const Val3ControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

ArmEmulator::~ArmEmulator() = default;

const std::string& ArmEmulator::address() const { return running_->address; }

Eigen::VectorXd ArmEmulator::position() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.position();
}

bool ArmEmulator::moving() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.moving();
}

int ArmEmulator::stops() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.stops();
}

}  // namespace handway::device
