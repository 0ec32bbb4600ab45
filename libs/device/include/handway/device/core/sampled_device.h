#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <stop_token>

namespace handway::device {

/// The time of a device's samples: s since it was first connected, never going back.
class SampleClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Sets the zero at the first call; later calls have no effect.
  void start() {
    if (!started_) {
      begin_ = Clock::now();
      started_ = true;
    }
  }

  [[nodiscard]] double seconds_at(Clock::time_point time) const {
    return std::chrono::duration<double>(time - begin_).count();
  }

  /// `time`, or that of the previous sample if it is later.
  double not_before_last(double time) {
    last_ = std::max(last_, time);
    return last_;
  }

 private:
  bool started_ = false;
  double last_ = 0.0;
  Clock::time_point begin_;
};

/// Result of waiting for a sample.
enum class SampleEvent {
  kSample,     ///< A sample.
  kNothing,    ///< No sample in the time given; call again.
  kUnplugged,  ///< The unit answers, but has no sensor; ask again.
  kEnd,        ///< End of a recording.
};

/// Errors on the line since the device object was made.
struct ReceptionFaults {
  std::uint64_t resynchronisations = 0;  ///< Times that bytes had to be dropped.
  std::uint64_t dropped_bytes = 0;
  std::uint64_t doubtful = 0;  ///< Records dropped because the device itself found them bad.
};

/// A device that returns samples, one after the other: a glove or a tracker. To be used by one
/// thread at a time; DeviceStream gives it a thread of its own.
///
/// @tparam InfoType properties that a connected device reports.
/// @tparam SampleType has a `time`, s.
template <typename InfoType, typename SampleType>
class SampledDevice {
 public:
  using Info = InfoType;
  using Sample = SampleType;
  /// Result of reading a device once.
  struct Reading {
    SampleEvent event = SampleEvent::kNothing;
    Sample sample;  ///< Valid for kSample.
  };

  virtual ~SampledDevice() = default;
  SampledDevice(const SampledDevice&) = delete;
  SampledDevice& operator=(const SampledDevice&) = delete;

  /// Opens the device and starts it; also again after a lost connection.
  /// @throws DeviceError with the state found, the expected one, and advice.
  Info connect(const std::stop_token& stop = {}) {
    disconnect();
    clock_.start();
    Info info = do_connect(stop);
    check_info(info);
    connected_ = true;
    return info;
  }

  /// Waits for the next sample, at most `timeout` (a little longer if the device has to be polled
  /// for a sign of life). Returns early, with kNothing, when a stop is requested. Time never goes
  /// back, not even from one connection to the next.
  /// @throws DeviceError if the connection is lost; connect() may restore it.
  /// @throws std::logic_error if it isn't connected.
  Reading next(std::chrono::milliseconds timeout, const std::stop_token& stop = {}) {
    if (!connected_) {
      throw std::logic_error("a device has to be connected before it is read");
    }
    Reading reading = do_next(timeout, stop);
    if (reading.event == SampleEvent::kSample) {
      check_sample(reading.sample);
      reading.sample.time = clock_.not_before_last(reading.sample.time);
    }
    return reading;
  }

  /// Stops and closes the device. Without effect if it isn't connected.
  void disconnect() noexcept {
    if (connected_) {
      connected_ = false;
      do_disconnect();
    }
  }

  [[nodiscard]] bool connected() const { return connected_; }
  [[nodiscard]] ReceptionFaults faults() const { return do_faults(); }
  /// Seconds since the first connect(), on the clock of the samples.
  [[nodiscard]] double now() const { return since_begin(Clock::now()); }

 protected:
  SampledDevice() = default;

  using Clock = SampleClock::Clock;
  /// Seconds from the first connect() to `time`.
  [[nodiscard]] double since_begin(Clock::time_point time) const { return clock_.seconds_at(time); }

 private:
  virtual Info do_connect(const std::stop_token& stop) = 0;
  virtual Reading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) = 0;
  virtual void do_disconnect() noexcept = 0;
  [[nodiscard]] virtual ReceptionFaults do_faults() const { return {}; }
  /// Checks rules of every device of this kind. @throws std::logic_error for one that breaks them.
  virtual void check_info(const Info& /*info*/) {}
  virtual void check_sample(const Sample& sample) const = 0;

  bool connected_ = false;
  SampleClock clock_;
};

}  // namespace handway::device
