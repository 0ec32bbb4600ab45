#include "handway/device/core/byte_link.h"

#include "core/links.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

namespace handway::device {

std::size_t ByteLink::read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout) {
  if (bytes.empty()) {
    return 0;
  }
  return do_read(bytes, std::max(timeout, std::chrono::milliseconds(0)));
}

void ByteLink::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds timeout) {
  if (!bytes.empty()) {
    do_write(bytes, timeout);
  }
}

std::unique_ptr<ByteLink> open_link(const std::string& address, int baud,
                                    const std::stop_token& stop) {
  constexpr std::string_view kListenPrefix = "listen://";
  if (address.starts_with(kListenPrefix)) {
    return accept_tcp_link(
        address, parse_port(address, std::string_view(address).substr(kListenPrefix.size())), stop);
  }
  const DeviceAddress parsed = parse_device_address(address);
  if (const auto* serial = std::get_if<SerialAddress>(&parsed)) {
    return open_serial_link(serial->path, baud);
  }
  return open_tcp_link(address, std::get<TcpAddress>(parsed), stop);
}

}  // namespace handway::device
