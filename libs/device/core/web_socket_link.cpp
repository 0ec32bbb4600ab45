#include "web_socket_link.h"

#include "bounded_read.h"
#include "handway/device/core/device_error.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <utility>

namespace handway::device {

namespace {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kConnectTimeout{2000};
constexpr milliseconds kStopPeriod{50};
constexpr std::size_t kLongestMessage = std::size_t{256} * 1024;

}  // namespace

struct WebSocketLink::Stream {
  explicit Stream(std::string given) : name(std::move(given)), socket(context) {}
  ~Stream() { abandon(); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  std::string name;
  asio::io_context context{1};
  websocket::stream<tcp::socket> socket;
  boost::beast::flat_buffer incoming;
  std::optional<std::string> received;  ///< And not yet taken: nothing is read meanwhile.
  error_code broken;                    ///< Why nothing more will come.

  // Handlers refer to this: none may be left.
  void abandon() {
    error_code ignored;
    socket.next_layer().close(ignored);
    context.restart();
    context.run();
  }

  [[noreturn]] void refuse(std::string found) const {
    throw DeviceError({name, "", std::move(found), "a device that accepts WebSocket connections",
                       "Look whether host and port are right and the device is switched on."});
  }

  [[noreturn]] void lost() const {
    if (broken == websocket::error::message_too_big) {
      throw DeviceError({name, "", "a message of more than 256 KiB", "shorter ones",
                         "Look whether the port is right."});
    }
    throw DeviceError({name, "", "the connection broke: " + broken.message(),
                       "a device that stays connected",
                       "Look whether it is switched on and plugged in."});
  }

  // Runs what `begin` starts with a handler until it is done.
  template <typename Begin>
  void finish(Clock::time_point deadline, const std::stop_token& stop, Begin begin) {
    error_code result = asio::error::would_block;
    begin([&result](const error_code& error, auto&&...) { result = error; });
    context.restart();
    while (result == asio::error::would_block && Clock::now() < deadline &&
           !stop.stop_requested()) {
      context.run_one_for(kStopPeriod);
    }
    if (result == asio::error::would_block) {
      abandon();
      refuse("no answer");
    }
    if (result) {
      refuse(result.message());
    }
  }

  void read_next() {
    socket.async_read(incoming, [this](const error_code& error, std::size_t) {
      if (error) {
        broken = error;
        return;
      }
      received = boost::beast::buffers_to_string(incoming.data());
      incoming.clear();
    });
  }
};

WebSocketLink::WebSocketLink(std::string name, const TcpAddress& address,
                             const std::stop_token& stop)
    : stream_(std::make_unique<Stream>(std::move(name))) {
  error_code error;
  tcp::resolver resolver(stream_->context);
  const auto endpoints = resolver.resolve(address.host, std::to_string(address.port), error);
  if (error) {
    stream_->refuse("unknown host: " + error.message());
  }
  const auto deadline = Clock::now() + kConnectTimeout;
  tcp::socket& socket = stream_->socket.next_layer();
  stream_->finish(deadline, stop,
                  [&](auto handler) { asio::async_connect(socket, endpoints, handler); });
  socket.set_option(tcp::no_delay(true), error);
  stream_->socket.read_message_max(kLongestMessage);
  const std::string host = address.host + ":" + std::to_string(address.port);
  stream_->finish(deadline, stop,
                  [&](auto handler) { stream_->socket.async_handshake(host, "/", handler); });
  stream_->socket.text(true);
  stream_->read_next();
}

WebSocketLink::~WebSocketLink() = default;

void WebSocketLink::send(std::string text, milliseconds timeout) {
  if (stream_->broken) {
    stream_->lost();
  }
  error_code result = asio::error::would_block;
  stream_->socket.async_write(asio::buffer(text),
                              [&result](const error_code& error, std::size_t) { result = error; });
  const auto deadline = Clock::now() + timeout;
  stream_->context.restart();
  while (result == asio::error::would_block && Clock::now() < deadline) {
    stream_->context.run_one_until(deadline);
  }
  if (result == asio::error::would_block) {
    stream_->abandon();
    throw DeviceError({stream_->name, "", "a device that takes no more messages",
                       "one that reads them", "Switch it off and on again."});
  }
  if (result) {
    stream_->broken = result;
    stream_->lost();
  }
}

std::optional<std::string> WebSocketLink::receive(milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  const auto latest = std::max(deadline, Clock::now() + ReadBudget::kLongest);
  stream_->context.restart();
  while (!stream_->received && !stream_->broken && Clock::now() < latest) {
    if (stream_->context.poll_one() > 0) {
      continue;
    }
    if (Clock::now() >= deadline) {
      break;
    }
    stream_->context.run_one_until(deadline);
  }
  if (!stream_->received) {
    if (stream_->broken) {
      stream_->lost();
    }
    return std::nullopt;
  }
  std::string text = *std::exchange(stream_->received, std::nullopt);
  if (!stream_->broken) {
    stream_->read_next();
  }
  return text;
}

}  // namespace handway::device
