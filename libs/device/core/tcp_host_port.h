#pragma once

#include "file_descriptor.h"
#include "host_port.h"

namespace handway::device {

/// A TCP port of this computer that one host at a time may connect to; a new connection takes
/// the place of the last.
class TcpHostPort final : public HostPort {
 public:
  /// @param port 0: any free one.
  /// @throws DeviceError if the port is taken or not allowed.
  explicit TcpHostPort(std::uint16_t port);

  [[nodiscard]] std::string address() const override;
  std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) override;
  void write(std::span<const std::uint8_t> bytes) override;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// How many hosts have connected so far.
  [[nodiscard]] int connections() const { return connections_; }
  [[nodiscard]] bool connected() const { return host_.valid(); }
  void disconnect() { host_.close(); }

 private:
  void accept_host();

  FileDescriptor listener_;
  FileDescriptor host_;
  std::uint16_t port_ = 0;
  int connections_ = 0;
};

}  // namespace handway::device
