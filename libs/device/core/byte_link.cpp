#include "handway/device/core/byte_link.h"

#include "handway/device/core/device_error.h"
#include "handway/geometric/io/input_error.h"
#include "links.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>
#include <termios.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

constexpr std::string_view kTcpPrefix = "tcp://";
constexpr std::string_view kListenPrefix = "listen://";

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

std::string without_brackets(std::string_view host) {
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  return std::string(host);
}

}  // namespace

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

namespace {

/// A ByteLink over any Boost.Asio stream that can be cancelled.
template <typename Stream>
class AsioLink : public ByteLink {
 public:
  explicit AsioLink(std::string name) : ByteLink(std::move(name)), stream_(context_) {}

  [[nodiscard]] Stream& stream() { return stream_; }
  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs the operation started on the stream until it is done or `timeout` is over; then cancels
  /// it. @returns whether it was done in time.
  bool run(std::chrono::milliseconds timeout) {
    context_.restart();
    context_.run_for(timeout);
    if (context_.stopped()) {
      return true;
    }
    boost::system::error_code ignored;
    stream_.cancel(ignored);
    context_.run();
    return false;
  }

 private:
  [[noreturn]] void lost(const boost::system::error_code& error) const {
    throw DeviceError({name(), "", "the connection broke: " + error.message(),
                       "a device that stays connected",
                       "Look whether it is switched on and plugged in."});
  }

  std::size_t do_read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout) override {
    boost::system::error_code error;
    std::size_t count = 0;
    stream_.async_read_some(boost::asio::buffer(bytes.data(), bytes.size()),
                            [&](const boost::system::error_code& result, std::size_t read) {
                              error = result;
                              count = read;
                            });
    run(timeout);
    if (error && error != boost::asio::error::operation_aborted) {
      lost(error);
    }
    return count;
  }

  void do_write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds timeout) override {
    boost::system::error_code error;
    boost::asio::async_write(
        stream_, boost::asio::buffer(bytes.data(), bytes.size()),
        [&](const boost::system::error_code& result, std::size_t) { error = result; });
    run(timeout);
    if (error == boost::asio::error::operation_aborted) {
      throw DeviceError({name(), "", "a device that takes no more bytes", "one that reads them",
                         "Switch it off and on again."});
    }
    if (error) {
      lost(error);
    }
  }

  boost::asio::io_context context_{1};
  Stream stream_;
};

using boost::asio::serial_port;
using boost::asio::serial_port_base;
using boost::system::error_code;

std::string advice_for(const error_code& error) {
  if (error == boost::system::errc::no_such_file_or_directory) {
    return "Plug the device in; `ls /dev/ttyUSB* /dev/ttyACM* /dev/rfcomm*` shows the serial ports "
           "that there are.";
  }
  if (error == boost::system::errc::permission_denied) {
    return "Add yourself to the group dialout (sudo adduser $USER dialout) and log in again.";
  }
  if (error == boost::system::errc::device_or_resource_busy) {
    return "End the program that uses it.";
  }
  return "Name a serial port, such as /dev/ttyUSB0, or HOST:PORT.";
}

[[noreturn]] void refuse(const std::string& path, const error_code& error) {
  throw DeviceError({path, "", error.message(), "a serial port", advice_for(error)});
}

}  // namespace

std::unique_ptr<ByteLink> open_serial_link(const std::string& path, int baud) {
  auto link = std::make_unique<AsioLink<serial_port>>(path);
  error_code error;
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(status) && !std::filesystem::is_character_file(status)) {
    throw DeviceError(
        {path, "", "a file or folder that is no device", "a serial port", advice_for(error)});
  }
  serial_port& port = link->stream();
  if (port.open(path, error)) {
    refuse(path, error);
  }
  port.set_option(serial_port_base::baud_rate(static_cast<unsigned>(baud)), error) ||
      port.set_option(serial_port_base::character_size(8), error) ||
      port.set_option(serial_port_base::parity(serial_port_base::parity::none), error) ||
      port.set_option(serial_port_base::stop_bits(serial_port_base::stop_bits::one), error) ||
      port.set_option(serial_port_base::flow_control(serial_port_base::flow_control::none), error);
  if (error) {
    refuse(path, error);
  }
  // Bytes for the former user of the port are discarded.
  ::tcflush(port.native_handle(), TCIOFLUSH);
  return link;
}

namespace {

using boost::asio::ip::tcp;
using std::chrono::milliseconds;

constexpr milliseconds kConnectTimeout{2000};
constexpr milliseconds kStopPeriod{50};

[[noreturn]] void refuse(const std::string& name, std::string found) {
  throw DeviceError({name, "", std::move(found), "a device that accepts connections",
                     "Look whether host and port are right and the device is switched on."});
}

}  // namespace

std::unique_ptr<ByteLink> open_tcp_link(const std::string& name, const TcpAddress& address,
                                        const std::stop_token& stop) {
  auto link = std::make_unique<AsioLink<tcp::socket>>(name);
  error_code error;
  tcp::resolver resolver(link->context());
  const auto endpoints = resolver.resolve(address.host, std::to_string(address.port), error);
  if (error) {
    refuse(name, "unknown host: " + error.message());
  }
  error = boost::asio::error::would_block;
  boost::asio::async_connect(
      link->stream(), endpoints,
      [&](const error_code& result, const tcp::endpoint&) { error = result; });
  link->context().restart();
  for (milliseconds waited{0}; error == boost::asio::error::would_block &&
                               waited < kConnectTimeout && !stop.stop_requested();
       waited += kStopPeriod) {
    link->context().run_for(kStopPeriod);
  }
  if (error == boost::asio::error::would_block) {
    // The handler refers to this frame: it has to be destroyed first.
    error_code ignored;
    link->stream().close(ignored);
    link->context().run();
    refuse(name, "no answer");
  }
  if (error) {
    refuse(name, error.message());
  }
  link->stream().set_option(tcp::no_delay(true), error);
  return link;
}

namespace {

constexpr milliseconds kLongestListening{60000};

// Waits until a device connects to `port` of this computer.
std::unique_ptr<ByteLink> accept_tcp_link(const std::string& name, std::uint16_t port,
                                          const std::stop_token& stop) {
  auto link = std::make_unique<AsioLink<tcp::socket>>(name);
  error_code error;
  tcp::acceptor acceptor(link->context());
  const tcp::endpoint endpoint(tcp::v4(), port);
  acceptor.open(endpoint.protocol(), error) ||
      acceptor.set_option(tcp::acceptor::reuse_address(true), error) ||
      acceptor.bind(endpoint, error) || acceptor.listen(1, error);
  if (error) {
    throw DeviceError({name, "", error.message(), "a TCP port of this computer that is free",
                       "End the program that uses it, or take another port."});
  }
  error = boost::asio::error::would_block;
  acceptor.async_accept(link->stream(), [&](const error_code& result) { error = result; });
  for (milliseconds waited{0}; error == boost::asio::error::would_block &&
                               waited < kLongestListening && !stop.stop_requested();
       waited += kStopPeriod) {
    link->context().run_for(kStopPeriod);
  }
  if (error) {
    error_code ignored;
    acceptor.close(ignored);
    link->context().run();
    throw DeviceError({name, "", "no device that connects", "one within a minute",
                       "Switch the device on, and look whether it was given this computer's "
                       "address and this port."});
  }
  link->stream().set_option(tcp::no_delay(true), error);
  return link;
}

}  // namespace

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
