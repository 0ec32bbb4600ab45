#include "handway/device/haptic/haptic_emulator.h"

#include "core/delayed_bytes.h"
#include "core/host_watch.h"
#include "core/tcp_host_port.h"

#include <array>
#include <chrono>
#include <mutex>
#include <string_view>
#include <thread>

namespace handway::device {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kTick{1000};
constexpr double kStatePeriod = 0.002;  // s

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace

struct HapticEmulator::Running {
  Running(const EmulatedHapticSettings& settings, std::uint16_t given)
      : device(settings), port(given), address("haptic://" + port.address()) {}

  mutable std::mutex mutex;  ///< Of the device.
  EmulatedHaptic device;
  TcpHostPort port;
  std::string address;
  LineBuffer lines;
  DelayedBytes sent;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void take(std::span<const std::uint8_t> bytes, double now);
  [[nodiscard]] double delay() const {
    return device.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void HapticEmulator::Running::take(std::span<const std::uint8_t> bytes, double now) {
  lines.add(bytes);
  try {
    while (const auto line = lines.next()) {
      sent.add(bytes_of(device.receive(*line, now)), now + delay());
    }
  } catch (const LineProtocolError&) {
    port.disconnect();
  }
}

void HapticEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  HostWatch host(port);
  double told = 0.0;
  bool cut = false;
  std::array<std::uint8_t, 4096> bytes{};
  while (!stop.stop_requested()) {
    const std::size_t count = port.read(bytes, kTick);
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    device.advance(now);
    if (host.lost()) {
      lines = {};
      sent.clear();
      device.connection_lost();
    }
    take(std::span(bytes).first(count), now);
    if (now - told >= kStatePeriod) {
      told = now;
      sent.add(bytes_of(device.feedback()), now + delay());
    }
    if (device.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      port.disconnect();
    }
    sent.send(port, now);
  }
}

HapticEmulator::HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

HapticEmulator::~HapticEmulator() = default;

const std::string& HapticEmulator::address() const { return running_->address; }

Eigen::Vector3d HapticEmulator::force() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->device.force();
}

}  // namespace handway::device
