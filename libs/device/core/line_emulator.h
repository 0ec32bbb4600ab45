#pragma once

#include "core/ports.h"
#include "handway/device/core/injected_fault.h"
#include "handway/device/core/line_protocol.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace handway::device {

/// An emulated device that speaks in lines, with its port, run by a thread of its own.
///
/// @tparam Device has, for one thread at a time, `advance(now)`, `receive(line, now)` and
/// `feedback()` (what it answers and reports), `connection_lost()` and `active_fault()`.
template <typename Device>
class LineEmulator {
 public:
  /// @param scheme of its address: "hand". @param port 0: any that is free.
  /// @param period in which it reports its state, s. @param settings of the device.
  /// @throws DeviceError if the port is taken.
  template <typename Settings>
  LineEmulator(const std::string& scheme, std::uint16_t port, double period,
               const Settings& settings)
      : device_(settings),
        port_(port),
        address_(scheme + "://" + port_.address()),
        period_(period),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  [[nodiscard]] const std::string& address() const { return address_; }

  /// What `question` says of the device, which stands still for that time.
  template <typename Question>
  [[nodiscard]] auto ask(Question question) const {
    const std::scoped_lock lock(mutex_);
    return question(device_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::microseconds kTick{1000};

  void run(const std::stop_token& stop) {
    const auto begin = Clock::now();
    HostWatch host(port_);
    double last_feedback = 0.0;
    bool cut = false;
    std::array<std::uint8_t, 16384> bytes{};
    while (!stop.stop_requested()) {
      const std::size_t count = port_.read(bytes, kTick);
      const double now = std::chrono::duration<double>(Clock::now() - begin).count();
      const std::scoped_lock lock(mutex_);
      device_.advance(now);
      if (host.lost()) {
        lines_ = {};
        sent_.clear();
        device_.connection_lost();
      }
      take(std::span(bytes).first(count), now);
      if (now - last_feedback >= period_) {
        last_feedback = now;
        send(device_.feedback(), now);
      }
      if (device_.active_fault() == FaultKind::kLost && !cut) {
        cut = true;
        port_.disconnect();
      }
      sent_.send(port_, now);
    }
  }

  void take(std::span<const std::uint8_t> bytes, double now) {
    lines_.add(bytes);
    try {
      while (const auto line = lines_.next()) {
        send(device_.receive(*line, now), now);
      }
    } catch (const LineProtocolError&) {
      port_.disconnect();
    }
  }

  void send(std::string_view text, double now) {
    const double delay = device_.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
    sent_.add({text.begin(), text.end()}, now + delay);
  }

  mutable std::mutex mutex_;  ///< Of the device.
  Device device_;
  TcpHostPort port_;
  std::string address_;
  double period_;  ///< s
  LineBuffer lines_;
  DelayedBytes sent_;
  std::jthread thread_;  ///< Last: it uses all the others.
};

}  // namespace handway::device
