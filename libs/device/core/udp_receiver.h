#pragma once

#include "file_descriptor.h"
#include "handway/device/core/device_address.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

struct sockaddr_in;  // NOLINT(readability-identifier-naming): the name of the system

namespace handway::device {

/// Reads "HOST:PORT", or "PORT" for this computer.
/// @throws geometric::InputError as parse_device_address().
[[nodiscard]] TcpAddress parse_udp_address(const std::string& text);

/// @param name as the user wrote the address.
/// @throws DeviceError if the host is not known.
[[nodiscard]] sockaddr_in resolve_ipv4(const std::string& name, const TcpAddress& address);

/// A UDP port that datagrams are taken from.
class UdpReceiver {
 public:
  /// @throws DeviceError if the port is taken or not allowed, or the host isn't this computer.
  UdpReceiver(const std::string& name, const TcpAddress& address);

  /// Waits for a datagram. @returns its length, of which what fits is put into `bytes`; nothing
  /// after `timeout` without one.
  [[nodiscard]] std::optional<std::size_t> receive(std::span<std::uint8_t> bytes,
                                                   std::chrono::microseconds timeout);

 private:
  FileDescriptor socket_;
};

}  // namespace handway::device
