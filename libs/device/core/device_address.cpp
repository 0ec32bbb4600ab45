#include "core/links.h"
#include "handway/device/core/byte_link.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>

namespace handway::device {
namespace {

constexpr std::string_view kTcpPrefix = "tcp://";

std::string without_brackets(std::string_view host) {
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  return std::string(host);
}

}  // namespace

std::uint16_t parse_port(const std::string& text, std::string_view port) {
  unsigned value = 0;
  const char* end = port.data() + port.size();
  const auto [stop, error] = std::from_chars(port.data(), end, value);
  if (error != std::errc() || stop != end || value == 0 || value > 65535) {
    throw geometric::InputError({text, "port", "\"" + std::string(port) + "\"",
                                 "a number from 1 to 65535", "Write HOST:PORT."});
  }
  return static_cast<std::uint16_t>(value);
}

DeviceAddress parse_device_address(const std::string& text) {
  const bool tcp = text.starts_with(kTcpPrefix);
  const std::string_view rest = tcp ? std::string_view(text).substr(kTcpPrefix.size()) : text;
  const std::size_t colon = rest.rfind(':');
  if (!tcp && (rest.find('/') != std::string_view::npos || colon == std::string_view::npos)) {
    if (text.empty()) {
      throw geometric::InputError({"device", "", "an empty name", "a serial port or HOST:PORT",
                                   "Write, for example, /dev/ttyUSB0 or localhost:5555."});
    }
    return SerialAddress{text};
  }
  if (colon == std::string_view::npos || colon == 0) {
    throw geometric::InputError(
        {text, "", "no host or no port", "HOST:PORT", "Write, for example, localhost:5555."});
  }
  return TcpAddress{without_brackets(rest.substr(0, colon)),
                    parse_port(text, rest.substr(colon + 1))};
}

TcpAddress parse_host_and_port(const std::string& text, std::uint16_t default_port) {
  const bool has_port =
      text.find(':', text.starts_with('[') ? text.find(']') : 0) != std::string::npos;
  return std::get<TcpAddress>(
      parse_device_address(has_port ? fmt::format("{}{}", kTcpPrefix, text)
                                    : fmt::format("{}{}:{}", kTcpPrefix, text, default_port)));
}

}  // namespace handway::device
