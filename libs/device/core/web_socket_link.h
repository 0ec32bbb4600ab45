#pragma once

#include "handway/device/core/device_address.h"

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace handway::device {

/// A WebSocket connection (RFC 6455, text messages) to a device. To be used by one thread at
/// a time.
class WebSocketLink {
 public:
  /// Connects, within 2 s.
  /// @param name of the device, for messages.
  /// @throws DeviceError if nobody answers, or nobody that speaks WebSocket.
  WebSocketLink(std::string name, const TcpAddress& address, const std::stop_token& stop);
  ~WebSocketLink();
  WebSocketLink(const WebSocketLink&) = delete;
  WebSocketLink& operator=(const WebSocketLink&) = delete;

  /// Sends a message.
  /// @throws DeviceError if the other end is gone or has not taken it within `timeout`.
  void send(std::string text, std::chrono::milliseconds timeout = std::chrono::seconds(1));

  /// The next message that came, of at most 256 KiB; waits at most `timeout` for one to begin, and
  /// at most 5 ms longer while it is coming. No more than one message is kept: what the other
  /// end sends beyond waits in its own buffers. One that came before the connection broke comes
  /// first.
  /// @throws DeviceError if the other end is gone or a message is longer.
  [[nodiscard]] std::optional<std::string> receive(std::chrono::milliseconds timeout);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace handway::device
