#pragma once

#include "handway/device/core/sample_clock.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove_frame.h"

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>

namespace handway::device {

/// What a connected glove reported of itself.
struct GloveInfo {
  std::string device;           ///< Port or file, as the user named it.
  std::string model;            ///< "CyberGlove, firmware 1.2".
  int sensors = kGloveSensors;  ///< See cyberglove_wired().
  bool right_hand = true;
  double rate = 0.0;  ///< Frames a second that it was asked for, Hz.
  double round_trip =
      0.0;  ///< Shortest time from a question to its answer, s; 0 if none was asked.
};

/// What came of waiting for a frame.
enum class GloveEvent {
  kFrame,      ///< A frame.
  kNothing,    ///< None within the time given; ask again.
  kUnplugged,  ///< The interface unit answers, but has no glove; ask again.
  kEnd,        ///< There are no more: the end of a recording.
};

struct GloveReading {
  GloveEvent event = GloveEvent::kNothing;
  GloveFrame frame;  ///< Of kFrame.
};

/// What went wrong on the line since the glove was made.
struct GloveLineFaults {
  std::uint64_t resynchronisations = 0;  ///< Times that bytes had to be dropped.
  std::uint64_t dropped_bytes = 0;
};

/// A sensorized glove (paper, section 3): frames of raw counts, one after the other. To be used
/// by one thread at a time; GloveStream gives it a thread of its own.
class HANDWAY_DEVICE_EXPORT Glove {
 public:
  virtual ~Glove() = default;
  Glove(const Glove&) = delete;
  Glove& operator=(const Glove&) = delete;

  /// Opens the device and starts it; after a lost connection, again.
  /// @throws DeviceError that says what was found, expected and is to be done.
  GloveInfo connect(const std::stop_token& stop = {});

  /// Waits for the next frame, at most `timeout` (a little longer where the device has to be asked
  /// whether it lives). Returns early, with kNothing, when a stop is requested.
  /// Every count of a sensor that the glove has is from 1 to 255, and time never goes back,
  /// not even from one connection to the next.
  /// @throws DeviceError if the connection is lost; connect() may bring it back.
  GloveReading next(std::chrono::milliseconds timeout, const std::stop_token& stop = {});

  /// Stops and closes the device. Without effect if it isn't connected.
  void disconnect() noexcept;

  [[nodiscard]] bool connected() const { return connected_; }
  [[nodiscard]] GloveLineFaults line_faults() const { return do_line_faults(); }
  /// Seconds since the first connect(), on the clock of the frames.
  [[nodiscard]] double now() const { return since_begin(Clock::now()); }

 protected:
  Glove() = default;

  using Clock = SampleClock::Clock;
  /// Seconds from the first connect() to `time`.
  [[nodiscard]] double since_begin(Clock::time_point time) const { return clock_.seconds_at(time); }

 private:
  virtual GloveInfo do_connect(const std::stop_token& stop) = 0;
  virtual GloveReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) = 0;
  virtual void do_disconnect() noexcept = 0;
  [[nodiscard]] virtual GloveLineFaults do_line_faults() const { return {}; }

  bool connected_ = false;
  int sensors_ = kGloveSensors;
  SampleClock clock_;
};

}  // namespace handway::device
