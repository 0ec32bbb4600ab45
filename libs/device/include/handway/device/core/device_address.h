#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <string>
#include <variant>

namespace handway::device {

/// A serial port, or a pseudo-terminal that stands for one.
struct SerialAddress {
  std::string path;  ///< "/dev/ttyUSB0".
};

/// A TCP port, as of a serial-to-network converter.
struct TcpAddress {
  std::string host;  ///< Name or number; an IPv6 number without its brackets.
  std::uint16_t port = 0;
};

using DeviceAddress = std::variant<SerialAddress, TcpAddress>;

/// Reads "HOST:PORT" or "tcp://HOST:PORT" as a TCP port, everything else as a serial port's path.
/// @throws geometric::InputError if `text` is empty or the port is no number from 1 to 65535.
[[nodiscard]] HANDWAY_DEVICE_EXPORT DeviceAddress parse_device_address(const std::string& text);

/// Reads "HOST[:PORT]".
/// @throws geometric::InputError as parse_device_address().
[[nodiscard]] HANDWAY_DEVICE_EXPORT TcpAddress parse_host_and_port(const std::string& text,
                                                                   std::uint16_t default_port);

}  // namespace handway::device
