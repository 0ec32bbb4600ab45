#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace handway::device {

/// The device's end of a line, for emulators: a pseudo-terminal or a listening TCP port.
class HostPort {
 public:
  virtual ~HostPort() = default;
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;

  /// What a host has to open.
  [[nodiscard]] virtual std::string address() const = 0;

  /// Waits for bytes from a host, at most `timeout`. @returns how many there are.
  virtual std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) = 0;

  /// Sends what a host takes; the rest is lost, as on a line without flow control.
  virtual void write(std::span<const std::uint8_t> bytes) = 0;

 protected:
  HostPort() = default;
};

/// @throws DeviceError if there are no pseudo-terminals.
[[nodiscard]] std::unique_ptr<HostPort> open_pseudo_terminal();

/// Listens on this computer only. @param port 0: any free one.
/// @throws DeviceError if the port is taken or not allowed.
[[nodiscard]] std::unique_ptr<HostPort> listen_on_tcp_port(std::uint16_t port);

/// Sends every record as a datagram to "HOST:PORT", whether somebody listens there or not; hears
/// nothing.
/// @throws geometric::InputError for a wrong address; DeviceError if there is no such host.
[[nodiscard]] std::unique_ptr<HostPort> send_to_udp_port(const std::string& receiver);

}  // namespace handway::device
