#pragma once

#include "handway/device/core/stream_state.h"
#include "handway/device/core/stream_statistics.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace handway::device {

/// A device that samples are read from, as a DeviceStream sees it. Used by the stream's thread.
class StreamedDevice {
 public:
  /// What came of waiting for a sample.
  enum class Event { kSample, kNothing, kUnplugged, kEnd };

  /// Of a connection: samples a second that should come (Hz; 0: unknown), and the time from a
  /// question to its answer (s; 0: none asked).
  struct Pace {
    double rate = 0.0;
    double round_trip = 0.0;
  };

  StreamedDevice() = default;
  virtual ~StreamedDevice() = default;
  StreamedDevice(const StreamedDevice&) = delete;
  StreamedDevice& operator=(const StreamedDevice&) = delete;

  /// Opens the device, and notifies whoever listens. @throws DeviceError
  virtual Pace connect(const std::stop_token& stop) = 0;
  /// Waits for a sample and keeps it for hand_over(). @throws DeviceError
  virtual Event next(std::chrono::milliseconds timeout, const std::stop_token& stop) = 0;
  /// Hands the sample to whoever listens. @returns its age afterwards, s.
  virtual double hand_over() = 0;
  virtual void disconnect() noexcept = 0;
  /// Times that bytes had to be dropped.
  [[nodiscard]] virtual std::uint64_t resynchronisations() const = 0;
};

/// The thread that reads a device: samples as they come, and a new connection when one is lost.
class DeviceStream {
 public:
  /// @param on_state is called on the thread; may be empty.
  DeviceStream(std::unique_ptr<StreamedDevice> device, const StreamSettings& settings,
               std::function<void(StreamState)> on_state);

  void request_stop() { thread_.request_stop(); }
  /// Waits for the end. @returns whether it came within `timeout`.
  bool wait(std::chrono::milliseconds timeout) const;

  [[nodiscard]] StreamState state() const;
  [[nodiscard]] std::string error() const;
  [[nodiscard]] StreamStatistics statistics() const;

 private:
  using Clock = std::chrono::steady_clock;

  void enter(StreamState next);
  void keep_error(const std::exception& problem);
  bool pause(std::chrono::milliseconds delay, const std::stop_token& stop) const;
  bool connect(const std::stop_token& stop);
  StreamState read(const std::stop_token& stop);
  void hand_over();
  StreamState run_to_end(const std::stop_token& stop);
  [[nodiscard]] double now() const;

  std::unique_ptr<StreamedDevice> device_;
  StreamSettings settings_;
  std::function<void(StreamState)> on_state_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  StreamState state_ = StreamState::kConnecting;
  std::string error_;
  StreamStatisticsCounter counter_;
  Clock::time_point begin_ = Clock::now();
  std::jthread thread_;  ///< Last: it uses all the others.
};

}  // namespace handway::device
