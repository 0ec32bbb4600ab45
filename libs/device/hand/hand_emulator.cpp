#include "handway/device/hand/hand_emulator.h"

#include "core/delayed_bytes.h"
#include "core/host_watch.h"
#include "core/tcp_host_port.h"
#include "handway/device/hand/hand_protocol.h"

#include <array>
#include <chrono>
#include <mutex>
#include <string_view>
#include <thread>

namespace handway::device {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kTick{1000};

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace

struct HandEmulator::Running {
  Running(const HandControllerSettings& settings, std::uint16_t given)
      : controller(settings), port(given), address("hand://" + port.address()) {}

  mutable std::mutex mutex;  ///< Of the controller.
  HandController controller;
  TcpHostPort port;
  std::string address;
  LineBuffer lines;
  DelayedBytes sent;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void take(std::span<const std::uint8_t> bytes, double now);
  [[nodiscard]] double delay() const {
    return controller.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void HandEmulator::Running::take(std::span<const std::uint8_t> bytes, double now) {
  lines.add(bytes);
  try {
    while (const auto line = lines.next()) {
      sent.add(bytes_of(controller.receive(*line, now)), now + delay());
    }
  } catch (const LineProtocolError&) {
    port.disconnect();
  }
}

void HandEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  HostWatch host(port);
  double told = 0.0;
  bool cut = false;
  std::array<std::uint8_t, 16384> bytes{};
  while (!stop.stop_requested()) {
    const std::size_t count = port.read(bytes, kTick);
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    controller.advance(now);
    if (host.lost()) {
      lines = {};
      sent.clear();
      controller.connection_lost();
    }
    take(std::span(bytes).first(count), now);
    if (now - told >= kHandStatePeriod) {
      told = now;
      sent.add(bytes_of(controller.feedback()), now + delay());
    }
    if (controller.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      port.disconnect();
    }
    sent.send(port, now);
  }
}

HandEmulator::HandEmulator(const HandControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

HandEmulator::~HandEmulator() = default;

const std::string& HandEmulator::address() const { return running_->address; }

Eigen::VectorXd HandEmulator::position() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.position();
}

bool HandEmulator::moving() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.moving();
}

}  // namespace handway::device
