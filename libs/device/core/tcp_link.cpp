#include "core/asio_link.h"
#include "core/links.h"
#include "handway/device/core/device_error.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;

constexpr milliseconds kConnectTimeout{2000};
constexpr milliseconds kStopPeriod{50};
constexpr milliseconds kLongestListening{60000};

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

}  // namespace handway::device
