#pragma once

#include "handway/device/core/stream_state.h"
#include "handway/device/core/stream_statistics.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace handway::device {

/// What a GloveStream reports, all of it on its own thread and one after the other; whoever has to
/// touch a window passes it on there. Any may be empty. None may throw.
struct GloveStreamHandlers {
  std::function<void(const GloveInfo& info)> on_connected;
  std::function<void(const GloveFrame& frame)> on_frame;
  std::function<void(StreamState state)> on_state;
};

/// A glove with a thread of its own: reads frames as they come, and connects again when the
/// connection is lost. All functions may be called from any thread but its own.
class HANDWAY_DEVICE_EXPORT GloveStream {
 public:
  /// Starts at once.
  GloveStream(std::unique_ptr<Glove> glove, const StreamSettings& settings,
              const GloveStreamHandlers& handlers);
  /// Stops; waits for the thread to end (at most some 100 ms and a handler's time).
  ~GloveStream();
  GloveStream(const GloveStream&) = delete;
  GloveStream& operator=(const GloveStream&) = delete;

  /// Asks it to stop; returns at once.
  void request_stop();

  /// Waits until it has ended, stopped or failed. @returns whether it has, within `timeout`.
  bool wait(std::chrono::milliseconds timeout) const;

  [[nodiscard]] StreamState state() const;
  /// What connect() reported last.
  [[nodiscard]] GloveInfo info() const;
  /// Why the connection was lost last, or never made; empty if it never was.
  [[nodiscard]] std::string error() const;
  [[nodiscard]] StreamStatistics statistics() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
