#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {

/// A WebSocket server (RFC 6455, text messages) on a TCP port of this computer, for emulators.
class WebSocketPort {
 public:
  using Host = std::uint64_t;  ///< A connection; numbers are not used again.

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

  /// Serves connections for `duration`. @returns what came, in order.
  [[nodiscard]] std::vector<Message> serve(std::chrono::microseconds duration);

  /// Who is connected.
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
