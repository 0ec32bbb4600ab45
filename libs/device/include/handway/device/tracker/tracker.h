#pragma once

#include "handway/device/core/sample_clock.h"
#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

namespace handway::device {

/// Where a sensor of a tracker was.
struct TrackerSample {
  double time = 0.0;  ///< When it arrived, s since the tracker was first connected.
  int sensor = 1;     ///< Which of the tracker's; Polhemus stations count from 1.
  /// Pose of the sensor's frame T in the frame S of the source (or transmitter), m.
  geometric::Pose X_ST = geometric::Pose::Identity();
  std::optional<bool> button;  ///< Whether it is pressed; nothing if the sensor has none.
};

/// What a connected tracker reported of itself.
struct TrackerInfo {
  std::string device;  ///< Port, as the user named it.
  std::string model;   ///< "Polhemus Fastrak, binary".
};

/// What came of waiting for a sample.
enum class TrackerEvent {
  kSample,     ///< A sample.
  kNothing,    ///< None within the time given; ask again.
  kUnplugged,  ///< The unit answers, but has no sensor; ask again.
};

struct TrackerReading {
  TrackerEvent event = TrackerEvent::kNothing;
  TrackerSample sample;  ///< Of kSample.
};

/// What went wrong since the tracker was made.
struct TrackerFaults {
  std::uint64_t resynchronisations = 0;  ///< Times that bytes had to be dropped.
  std::uint64_t dropped_bytes = 0;
  std::uint64_t doubtful = 0;  ///< Records dropped because the device itself found them bad.
};

/// A tracker of the wrist's pose (paper, section 3): samples of one sensor or several, one after
/// the other. To be used by one thread at a time.
class HANDWAY_DEVICE_EXPORT Tracker {
 public:
  virtual ~Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  /// Opens the device and starts it; after a lost connection, again.
  /// @throws DeviceError that says what was found, expected and is to be done.
  TrackerInfo connect(const std::stop_token& stop = {});

  /// Waits for the next sample, at most `timeout`. Returns early, with kNothing, when a stop is
  /// requested. Poses are finite and rigid, and time never goes back, not even from one
  /// connection to the next.
  /// @throws DeviceError if the connection is lost; connect() may bring it back.
  TrackerReading next(std::chrono::milliseconds timeout, const std::stop_token& stop = {});

  /// Stops and closes the device. Without effect if it isn't connected.
  void disconnect() noexcept;

  [[nodiscard]] bool connected() const { return connected_; }
  [[nodiscard]] TrackerFaults faults() const { return do_faults(); }
  /// Seconds since the first connect(), on the clock of the samples.
  [[nodiscard]] double now() const { return since_begin(Clock::now()); }

 protected:
  Tracker() = default;

  using Clock = SampleClock::Clock;
  /// Seconds from the first connect() to `time`.
  [[nodiscard]] double since_begin(Clock::time_point time) const { return clock_.seconds_at(time); }

 private:
  virtual TrackerInfo do_connect(const std::stop_token& stop) = 0;
  virtual TrackerReading do_next(std::chrono::milliseconds timeout,
                                 const std::stop_token& stop) = 0;
  virtual void do_disconnect() noexcept = 0;
  [[nodiscard]] virtual TrackerFaults do_faults() const = 0;

  bool connected_ = false;
  SampleClock clock_;
};

}  // namespace handway::device
