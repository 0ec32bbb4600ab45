#pragma once

#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_address.h"

namespace handway::device {

[[nodiscard]] std::unique_ptr<ByteLink> open_serial_link(const std::string& path, int baud);

/// @param name as the user wrote the address.
[[nodiscard]] std::unique_ptr<ByteLink> open_tcp_link(const std::string& name,
                                                      const TcpAddress& address,
                                                      const std::stop_token& stop);

}  // namespace handway::device
