#pragma once

#include "handway/device/export.h"

#include <chrono>

namespace handway::device {

/// How a device that streams is doing.
enum class StreamState {
  kConnecting,  ///< For the first time.
  kStreaming,   ///< Samples come.
  kUnplugged,   ///< The unit answers, but has no sensor.
  kLost,        ///< Was connected; tries again and again.
  kEnded,       ///< The recording is over.
  kStopped,     ///< As asked.
  kFailed,      ///< Gave up; see the stream's error().
};

/// "connecting", "streaming", … for people.
[[nodiscard]] HANDWAY_DEVICE_EXPORT const char* state_name(StreamState state);

struct StreamSettings {
  bool wait_for_device = false;                ///< Keep trying even if the first connect() fails.
  bool reconnect = true;                       ///< After a lost connection.
  std::chrono::milliseconds first_delay{100};  ///< Before connecting again; doubles each time,
  std::chrono::milliseconds longest_delay{2000};  ///< up to this.
};

}  // namespace handway::device
