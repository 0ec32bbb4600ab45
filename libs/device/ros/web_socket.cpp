#include "ros/web_socket.h"

#include "core/links.h"
#include "handway/device/core/device_error.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <deque>
#include <map>
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
  std::optional<std::string> received;  ///< Not taken yet: reading waits meanwhile.
  error_code broken;                    ///< Error that ended the reading.

  // Handlers refer to this: none may remain.
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

  // Runs the operation that `begin` starts with a handler until it is done.
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

namespace {

// A host that doesn't read loses messages beyond this number.
constexpr std::size_t kMostWaiting = 1000;

}  // namespace

struct WebSocketPort::Server {
  struct Session : std::enable_shared_from_this<Session> {
    Session(Server& given, Host id, tcp::socket socket)
        : server(given), host(id), stream(std::move(socket)) {}

    Server& server;
    Host host;
    websocket::stream<tcp::socket> stream;
    boost::beast::flat_buffer incoming;
    std::deque<std::string> outgoing;  ///< The first is being sent.
    bool open = false;

    void accept();
    void read();
    void write();
    void end();
  };

  explicit Server(std::uint16_t port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  std::map<Host, std::shared_ptr<Session>> sessions;
  std::vector<Message> received;
  Host next = 1;

  void listen();
};

void WebSocketPort::Server::Session::accept() {
  stream.async_accept([self = shared_from_this()](const error_code& error) {
    if (error) {
      self->end();
      return;
    }
    self->open = true;
    self->stream.text(true);
    self->read();
  });
}

void WebSocketPort::Server::Session::read() {
  stream.async_read(incoming, [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error) {
      self->end();
      return;
    }
    self->server.received.push_back(
        {self->host, boost::beast::buffers_to_string(self->incoming.data())});
    self->incoming.clear();
    self->read();
  });
}

void WebSocketPort::Server::Session::write() {
  stream.async_write(asio::buffer(outgoing.front()),
                     [self = shared_from_this()](const error_code& error, std::size_t) {
                       if (error) {
                         self->end();
                         return;
                       }
                       self->outgoing.pop_front();
                       if (!self->outgoing.empty()) {
                         self->write();
                       }
                     });
}

void WebSocketPort::Server::Session::end() {
  error_code ignored;
  stream.next_layer().close(ignored);
  open = false;
  server.sessions.erase(host);
}

WebSocketPort::Server::Server(std::uint16_t port) {
  try {
    const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
    acceptor.open(endpoint.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    throw DeviceError({"TCP port " + std::to_string(port), "", error.code().message(),
                       "a port that is free", "Take another one; 0 takes any that is free."});
  }
  listen();
}

// Handlers refer to sessions, and these to the server: none may remain.
WebSocketPort::Server::~Server() {
  error_code ignored;
  acceptor.close(ignored);
  for (const auto& [host, session] : sessions) {
    session->stream.next_layer().close(ignored);
  }
  context.restart();
  context.run();
}

void WebSocketPort::Server::listen() {
  acceptor.async_accept([this](const error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) {
      return;
    }
    if (!error) {
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      const Host host = next++;
      sessions[host] = std::make_shared<Session>(*this, host, std::move(socket));
      sessions[host]->accept();
    }
    listen();
  });
}

WebSocketPort::WebSocketPort(std::uint16_t port) : server_(std::make_unique<Server>(port)) {}

WebSocketPort::~WebSocketPort() = default;

std::uint16_t WebSocketPort::port() const { return server_->acceptor.local_endpoint().port(); }

std::vector<WebSocketPort::Message> WebSocketPort::serve(std::chrono::microseconds duration) {
  server_->context.restart();
  server_->context.run_for(duration);
  return std::exchange(server_->received, {});
}

std::vector<WebSocketPort::Host> WebSocketPort::hosts() const {
  std::vector<Host> hosts;
  for (const auto& [host, session] : server_->sessions) {
    if (session->open) {
      hosts.push_back(host);
    }
  }
  return hosts;
}

void WebSocketPort::send(Host host, std::string text) {
  const auto found = server_->sessions.find(host);
  if (found == server_->sessions.end() || !found->second->open ||
      found->second->outgoing.size() >= kMostWaiting) {
    return;
  }
  found->second->outgoing.push_back(std::move(text));
  if (found->second->outgoing.size() == 1) {
    found->second->write();
  }
}

void WebSocketPort::disconnect() {
  for (const auto& [host, session] : server_->sessions) {
    error_code ignored;
    session->stream.next_layer().close(ignored);
  }
}

}  // namespace handway::device
