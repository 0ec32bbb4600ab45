#pragma once

#include "handway/device/core/sampled_device.h"
#include "handway/device/export.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace handway::device {

/// State of a streaming device.
enum class StreamState {
  kConnecting,  ///< For the first time.
  kStreaming,   ///< Samples come.
  kUnplugged,   ///< The unit answers, but has no sensor.
  kLost,        ///< Was connected; tries again and again.
  kEnded,       ///< The recording is over.
  kStopped,     ///< Stopped on request.
  kFailed,      ///< Gave up; see the stream's error().
};

/// Name for display: "connecting", "streaming", …
[[nodiscard]] HANDWAY_DEVICE_EXPORT const char* state_name(StreamState state);

/// Settings of a device stream: how it connects, and connects again.
struct StreamSettings {
  bool wait_for_device = false;                ///< Keep trying even if the first connect() fails.
  bool reconnect = true;                       ///< After a lost connection.
  std::chrono::milliseconds first_delay{100};  ///< Before connecting again; doubles each time,
  std::chrono::milliseconds longest_delay{2000};  ///< up to this.
};

/// Quality of a stream of frames.
struct StreamStatistics {
  std::uint64_t frames = 0;
  double rate = 0.0;      ///< Frames a second over the last second, Hz.
  double jitter = 0.0;    ///< Mean deviation of the last second's intervals from their mean, s.
  double latency = 0.0;   ///< Round-trip time of a query on this connection, s; 0: no query.
  double handling = 0.0;  ///< Mean time that a frame took from its arrival to the end of
                          ///< its handler, over the last second, s.
  std::uint64_t dropouts = 0;  ///< Intervals longer than 3.5 of the requested rate's.
  double longest_gap = 0.0;    ///< Longest interval between two frames, s.
  std::uint64_t reconnects = 0;
  std::uint64_t resynchronisations = 0;  ///< Times that bytes had to be dropped.
};

/// Computes StreamStatistics of frames as they arrive.
class HANDWAY_DEVICE_EXPORT StreamStatisticsCounter {
 public:
  /// Records a new connection with the expected rate (frames per second, Hz).
  void connected(double rate, double round_trip);

  /// Records a frame that arrived at `time` (s, never falling) and was handled at `handled`.
  void frame(double time, double handled);

  void resynchronised(std::uint64_t total) { statistics_.resynchronisations = total; }

  /// @param now s, on the frames' clock.
  [[nodiscard]] StreamStatistics at(double now) const;

 private:
  struct Arrival {
    double time;
    double handling;
  };

  StreamStatistics statistics_;
  std::deque<Arrival> recent_;
  double period_ = 0.0;
  double last_time_ = 0.0;
  bool begun_ = false;
};

/// A device that samples are read from, as used by its StreamThread. Used by that thread alone.
class StreamSource {
 public:
  /// Pace of a connection: expected samples per second (Hz; 0: unknown), and the round-trip time of
  /// a query (s; 0: no query).
  struct Pace {
    double rate = 0.0;
    double round_trip = 0.0;
  };

  StreamSource() = default;
  virtual ~StreamSource() = default;
  StreamSource(const StreamSource&) = delete;
  StreamSource& operator=(const StreamSource&) = delete;

  /// Opens the device, and notifies the handler. @throws DeviceError
  virtual Pace connect(const std::stop_token& stop) = 0;
  /// Waits for a sample and stores it for hand_over(). @throws DeviceError
  virtual SampleEvent next(std::chrono::milliseconds timeout, const std::stop_token& stop) = 0;
  /// Passes the sample to the handler. @returns its age afterwards, s.
  virtual double hand_over() = 0;
  virtual void disconnect() noexcept = 0;
  /// Times that bytes had to be dropped.
  [[nodiscard]] virtual std::uint64_t resynchronisations() const = 0;
};

/// The thread of a device: reads samples as they come, and reconnects after a loss.
class HANDWAY_DEVICE_EXPORT StreamThread {
 public:
  /// @param on_state is called on the thread; may be empty.
  StreamThread(std::unique_ptr<StreamSource> source, const StreamSettings& settings,
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

  std::unique_ptr<StreamSource> source_;
  StreamSettings settings_;
  std::function<void(StreamState)> on_state_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  StreamState state_ = StreamState::kConnecting;
  std::string error_;
  StreamStatisticsCounter counter_;
  Clock::time_point begin_ = Clock::now();
  std::jthread thread_;  ///< Last: it uses all other members.
};

/// A device with a thread of its own: reads samples as they come, and reconnects after a loss. All
/// functions may be called from any thread but its own.
/// @tparam Device a SampledDevice.
template <typename Device>
class DeviceStream {
 public:
  using Info = typename Device::Info;
  using Sample = typename Device::Sample;

  /// Callbacks, all called on the stream's own thread, one after the other; those that touch a
  /// window have to forward to its thread. Any may be empty. None may throw.
  struct Handlers {
    std::function<void(const Info& info)> on_connected;
    std::function<void(const Sample& sample)> on_sample;
    std::function<void(StreamState state)> on_state;
  };

  /// Starts at once. The destructor stops it, and waits for the thread to end (at most some 100 ms
  /// and a handler's time).
  DeviceStream(std::unique_ptr<Device> device, const StreamSettings& settings,
               const Handlers& handlers)
      : thread_(std::make_unique<Source>(std::move(device), handlers, reports_), settings,
                handlers.on_state) {}

  /// Requests a stop; returns at once.
  void request_stop() { thread_.request_stop(); }
  /// Waits until it has ended, stopped or failed. @returns whether it has, within `timeout`.
  bool wait(std::chrono::milliseconds timeout) const { return thread_.wait(timeout); }

  [[nodiscard]] StreamState state() const { return thread_.state(); }
  /// Result of the last connect().
  [[nodiscard]] Info info() const {
    const std::lock_guard lock(reports_->mutex);
    return reports_->info;
  }
  /// Reason of the last lost or failed connection; empty if there was none.
  [[nodiscard]] std::string error() const { return thread_.error(); }
  [[nodiscard]] StreamStatistics statistics() const { return thread_.statistics(); }

 private:
  struct Reports {
    std::mutex mutex;
    Info info;
  };

  class Source final : public StreamSource {
   public:
    Source(std::unique_ptr<Device> device, Handlers handlers, std::shared_ptr<Reports> reports)
        : device_(std::move(device)),
          handlers_(std::move(handlers)),
          reports_(std::move(reports)) {}

    Pace connect(const std::stop_token& stop) override {
      const Info info = device_->connect(stop);
      {
        const std::lock_guard lock(reports_->mutex);
        reports_->info = info;
      }
      if (handlers_.on_connected) {
        handlers_.on_connected(info);
      }
      if constexpr (requires { Pace{info.rate, info.round_trip}; }) {
        return {info.rate, info.round_trip};
      } else {
        return {};
      }
    }

    SampleEvent next(std::chrono::milliseconds timeout, const std::stop_token& stop) override {
      const typename Device::Reading reading = device_->next(timeout, stop);
      if (reading.event == SampleEvent::kSample) {
        sample_ = reading.sample;
      }
      return reading.event;
    }

    double hand_over() override {
      if (handlers_.on_sample) {
        handlers_.on_sample(sample_);
      }
      return device_->now() - sample_.time;
    }

    void disconnect() noexcept override { device_->disconnect(); }

    [[nodiscard]] std::uint64_t resynchronisations() const override {
      return device_->faults().resynchronisations;
    }

   private:
    std::unique_ptr<Device> device_;
    Handlers handlers_;
    std::shared_ptr<Reports> reports_;
    Sample sample_;
  };

  std::shared_ptr<Reports> reports_ = std::make_shared<Reports>();
  StreamThread thread_;  ///< Last: it uses the reports.
};

}  // namespace handway::device
