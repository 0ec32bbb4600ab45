#pragma once

#include "handway/device/core/stream_state.h"
#include "handway/device/core/stream_statistics.h"
#include "handway/device/export.h"
#include "handway/device/tracker/tracker.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace handway::device {

/// What a TrackerStream reports, all of it on its own thread and one after the other; whoever has
/// to touch a window passes it on there. Any may be empty. None may throw.
struct TrackerStreamHandlers {
  std::function<void(const TrackerInfo& info)> on_connected;
  std::function<void(const TrackerSample& sample)> on_sample;
  std::function<void(StreamState state)> on_state;
};

/// A tracker with a thread of its own: reads the samples of all sensors as they come, and connects
/// again when the connection is lost. All functions may be called from any thread but its own.
class HANDWAY_DEVICE_EXPORT TrackerStream {
 public:
  /// Starts at once.
  TrackerStream(std::unique_ptr<Tracker> tracker, const StreamSettings& settings,
                const TrackerStreamHandlers& handlers);
  /// Stops; waits for the thread to end (at most some 100 ms and a handler's time).
  ~TrackerStream();
  TrackerStream(const TrackerStream&) = delete;
  TrackerStream& operator=(const TrackerStream&) = delete;

  /// Asks it to stop; returns at once.
  void request_stop();

  /// Waits until it has ended, stopped or failed. @returns whether it has, within `timeout`.
  bool wait(std::chrono::milliseconds timeout) const;

  [[nodiscard]] StreamState state() const;
  /// What connect() reported last.
  [[nodiscard]] TrackerInfo info() const;
  /// Why the connection was lost last, or never made; empty if it never was.
  [[nodiscard]] std::string error() const;
  [[nodiscard]] StreamStatistics statistics() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
