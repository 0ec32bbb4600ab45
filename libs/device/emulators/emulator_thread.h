#pragma once

#include "core/ports.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/emulators/emulated_robot.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace handway::device {

/// Delay of the messages of a device with that fault, s.
[[nodiscard]] inline double delay_of(FaultKind fault) {
  return fault == FaultKind::kLate ? 0.6 : 0.0;
}

/// An emulated device with its ports, run by a thread of its own.
///
/// @tparam Device has, for one thread at a time, `advance(now)` and `active_fault()`.
/// @tparam Ports has `address()`, `wait(time)` for messages of hosts, `take(device, now)`, which
/// passes them to the device, `report(device, now)` of its state, `send(now)`, which sends messages
/// that are due, and `disconnect()`.
template <typename Device, typename Ports>
class EmulatorThread {
 public:
  /// @param period of its state reports, s. @param settings of the device.
  /// @param ports arguments of their constructor. @throws DeviceError if one is taken.
  template <typename Settings, typename... Arguments>
  EmulatorThread(double period, const Settings& settings, const Arguments&... ports)
      : device_(settings),
        ports_(ports...),
        address_(ports_.address()),
        period_(period),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  [[nodiscard]] const std::string& address() const { return address_; }

  /// Returns the result of `question` on the device, which is locked meanwhile.
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
    double last_report = 0.0;
    bool cut = false;
    while (!stop.stop_requested()) {
      ports_.wait(kTick);
      const double now = std::chrono::duration<double>(Clock::now() - begin).count();
      const std::scoped_lock lock(mutex_);
      device_.advance(now);
      ports_.take(device_, now);
      if (now - last_report >= period_) {
        last_report = now;
        ports_.report(device_, now);
      }
      if (device_.active_fault() == FaultKind::kLost && !cut) {
        cut = true;
        ports_.disconnect();
      }
      ports_.send(now);
    }
  }

  mutable std::mutex mutex_;  ///< Guards the device.
  Device device_;
  Ports ports_;
  std::string address_;
  double period_;        ///< s
  std::jthread thread_;  ///< Last: it uses all other members.
};

/// Interface of a RobotEmulator's thread.
class RobotEmulator::Running {
 public:
  virtual ~Running() = default;

  [[nodiscard]] virtual const std::string& address() const = 0;
  /// Calls `question` with the locked robot.
  virtual void ask(const std::function<void(const EmulatedRobot&)>& question) const = 0;
};

/// @tparam Robot an EmulatedRobot. @tparam Ports as EmulatorThread's.
template <typename Robot, typename Ports>
class RunningRobot final : public RobotEmulator::Running {
 public:
  template <typename... Arguments>
  explicit RunningRobot(const Arguments&... arguments) : thread_(arguments...) {}

  [[nodiscard]] const std::string& address() const override { return thread_.address(); }
  void ask(const std::function<void(const EmulatedRobot&)>& question) const override {
    thread_.ask(question);
  }

 private:
  EmulatorThread<Robot, Ports> thread_;
};

/// A port for EmulatorThread, of a device with a protocol of lines. The device has `receive(line,
/// now)` for answers, `feedback()` for reports, and `connection_lost()`.
class LinePort {
 public:
  /// @param scheme of its address: "hand". @param port 0: any free one.
  LinePort(std::string scheme, std::uint16_t port) : scheme_(std::move(scheme)), port_(port) {}

  [[nodiscard]] std::string address() const { return scheme_ + "://" + port_.address(); }
  void wait(std::chrono::microseconds time) { count_ = port_.read(bytes_, time); }
  void disconnect() { port_.disconnect(); }
  void send(double now) { said_.send(port_, now); }

  template <typename Device>
  void take(Device& device, double now) {
    if (host_.lost()) {
      lines_ = {};
      said_.clear();
      device.connection_lost();
    }
    lines_.add(std::span(bytes_).first(count_));
    try {
      while (const auto line = lines_.next()) {
        add(device.receive(*line, now), now + delay_of(device.active_fault()));
      }
    } catch (const LineProtocolError&) {
      port_.disconnect();
    }
  }

  template <typename Device>
  void report(Device& device, double now) {
    add(device.feedback(), now + delay_of(device.active_fault()));
  }

 private:
  void add(std::string_view text, double due) { said_.add({text.begin(), text.end()}, due); }

  std::string scheme_;
  TcpHostPort port_;
  HostWatch host_{port_};
  std::array<std::uint8_t, 16384> bytes_{};
  std::size_t count_ = 0;
  LineBuffer lines_;
  DelayedBytes said_;
};

}  // namespace handway::device
