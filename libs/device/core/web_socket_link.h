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
  /// @throws DeviceError if the other end is gone or takes nothing for a second.
  void send(std::string text);

  /// The next message that came; waits at most `timeout` for one. Those that came before the
  /// connection broke come first.
  /// @throws DeviceError if the other end is gone.
  [[nodiscard]] std::optional<std::string> receive(std::chrono::milliseconds timeout);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace handway::device
