#include "handway/device/core/stream_state.h"

namespace handway::device {

const char* state_name(StreamState state) {
  switch (state) {
    case StreamState::kConnecting:
      return "connecting";
    case StreamState::kStreaming:
      return "streaming";
    case StreamState::kUnplugged:
      return "unplugged";
    case StreamState::kLost:
      return "lost";
    case StreamState::kEnded:
      return "ended";
    case StreamState::kStopped:
      return "stopped";
    case StreamState::kFailed:
      return "failed";
  }
  return "unknown";
}

}  // namespace handway::device
