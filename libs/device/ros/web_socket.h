#pragma once

#include "handway/device/core/byte_link.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::device {

/// A WebSocket connection (RFC 6455, text messages) to a device. To be used by one thread at
/// a time.
class WebSocketLink {
 public:
  /// Connects, within 2 s.
  /// @param name of the device, for messages.
  /// @throws DeviceError if no server answers, or none with WebSocket.
  WebSocketLink(std::string name, const TcpAddress& address, const std::stop_token& stop);
  ~WebSocketLink();
  WebSocketLink(const WebSocketLink&) = delete;
  WebSocketLink& operator=(const WebSocketLink&) = delete;

  /// Sends a message.
  /// @throws DeviceError if the other end is gone or has not taken it within `timeout`.
  void send(std::string text, std::chrono::milliseconds timeout = std::chrono::seconds(1));

  /// The next message, of at most 256 KiB; waits at most `timeout` for one to begin, and
  /// at most 5 ms longer while it is coming. At most one message is stored: later ones
  /// wait in the sender's buffers. A message that came before the connection broke comes
  /// first.
  /// @throws DeviceError if the other end is gone or a message is longer.
  [[nodiscard]] std::optional<std::string> receive(std::chrono::milliseconds timeout);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// A WebSocket server (RFC 6455, text messages) on a TCP port of this computer, for emulators.
class WebSocketPort {
 public:
  using Host = std::uint64_t;  ///< A connection; numbers are not reused.

  struct Message {
    Host host = 0;
    std::string text;
  };

  /// @param port 0: any free one.
  /// @throws DeviceError if the port is taken or not allowed.
  explicit WebSocketPort(std::uint16_t port);
  ~WebSocketPort();
  WebSocketPort(const WebSocketPort&) = delete;
  WebSocketPort& operator=(const WebSocketPort&) = delete;

  [[nodiscard]] std::uint16_t port() const;

  /// Serves connections for `duration`. @returns the events, in order.
  [[nodiscard]] std::vector<Message> serve(std::chrono::microseconds duration);

  /// Connected hosts.
  [[nodiscard]] std::vector<Host> hosts() const;
  /// Sends a message; nothing happens if the host is gone.
  void send(Host host, std::string text);
  /// Cuts all connections.
  void disconnect();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace handway::device
