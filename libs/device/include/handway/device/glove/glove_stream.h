#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/stream_statistics.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace handway::device {

enum class GloveState {
  kConnecting,  ///< For the first time.
  kStreaming,   ///< Frames come.
  kUnplugged,   ///< The interface unit answers, but has no glove.
  kLost,        ///< Was connected; tries again and again.
  kEnded,       ///< The recording is over.
  kStopped,     ///< As asked.
  kFailed,      ///< Gave up; see GloveStream::error().
};

/// "connecting", "streaming", … for people.
[[nodiscard]] HANDWAY_DEVICE_EXPORT const char* state_name(GloveState state);

struct GloveStreamSettings {
  bool wait_for_device = false;                ///< Keep trying even if the first connect() fails.
  bool reconnect = true;                       ///< After a lost connection.
  std::chrono::milliseconds first_delay{100};  ///< Before connecting again; doubles each time,
  std::chrono::milliseconds longest_delay{2000};  ///< up to this.
};

/// What a GloveStream tells, all of it on its own thread and one after the other; whoever has to
/// touch a window passes it on there. Any may be empty. None may throw.
struct GloveStreamHandlers {
  std::function<void(const GloveInfo& info)> on_connected;
  std::function<void(const GloveFrame& frame)> on_frame;
  std::function<void(GloveState state)> on_state;
};

/// A glove with a thread of its own: reads frames as they come, and connects again when the
/// connection is lost. All functions may be called from any thread but its own.
class HANDWAY_DEVICE_EXPORT GloveStream {
 public:
  /// Starts at once.
  GloveStream(std::unique_ptr<Glove> glove, const GloveStreamSettings& settings,
              GloveStreamHandlers handlers);
  /// Stops; waits for the thread to end (at most some 100 ms and a handler's time).
  ~GloveStream();
  GloveStream(const GloveStream&) = delete;
  GloveStream& operator=(const GloveStream&) = delete;

  /// Asks it to stop; returns at once.
  void request_stop();

  /// Waits until it has ended, stopped or failed. @returns whether it has, within `timeout`.
  bool wait(std::chrono::milliseconds timeout) const;

  [[nodiscard]] GloveState state() const;
  /// What connect() told last.
  [[nodiscard]] GloveInfo info() const;
  /// Why the connection was lost last, or never made; empty if it never was.
  [[nodiscard]] std::string error() const;
  [[nodiscard]] StreamStatistics statistics() const;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace handway::device
