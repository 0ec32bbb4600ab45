#include "asio_link.h"
#include "links.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <algorithm>

namespace handway::device {

namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
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
    // The handler refers to this frame: it has to be gone before.
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

}  // namespace handway::device
