#include "core/ports.h"
#include "handway/device/core/device_error.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

// Returns the number of bytes read; closes a connection that is over.
std::size_t read_connection(FileDescriptor& connection, std::span<std::uint8_t> bytes) {
  const ssize_t count = ::read(connection.get(), bytes.data(), bytes.size());
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
    connection.close();
  }
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

void write_connection(FileDescriptor& connection, std::span<const std::uint8_t> bytes) {
  if (connection.valid() &&
      ::send(connection.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN) {
    connection.close();
  }
}

void set_up_connection(const FileDescriptor& connection) {
  connection.make_nonblocking();
  const int on = 1;
  ::setsockopt(connection.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
}

class TcpDialler final : public HostPort {
 public:
  TcpDialler(const std::string& host, std::vector<std::uint8_t> greeting)
      : host_address_(resolve_ipv4(host, parse_udp_address(host))),
        greeting_(std::move(greeting)) {}

  [[nodiscard]] std::string address() const override {
    return "listen://" + std::to_string(ntohs(host_address_.sin_port));
  }

  std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) override {
    if (!socket_.valid() && !connect()) {
      std::this_thread::sleep_for(timeout);
      return 0;
    }
    return socket_.wait_readable(timeout) ? read_connection(socket_, bytes) : 0;
  }

  void write(std::span<const std::uint8_t> bytes) override { write_connection(socket_, bytes); }

 private:
  bool connect() {
    FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&host_address_),
                  sizeof(host_address_)) != 0) {
      return false;
    }
    set_up_connection(socket);
    socket_ = std::move(socket);
    write(greeting_);
    return true;
  }

  sockaddr_in host_address_;
  std::vector<std::uint8_t> greeting_;
  FileDescriptor socket_;
};

}  // namespace

TcpHostPort::TcpHostPort(std::uint16_t port)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int on = 1;
  // Lets an emulator that was killed be started again on its port.
  ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  socklen_t size = sizeof(address);
  if (::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      ::listen(listener_.get(), 1) != 0 ||
      ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw DeviceError({"TCP port " + std::to_string(port), "", std::strerror(errno),
                       "a port that is free", "Take another one; 0 takes any that is free."});
  }
  listener_.make_nonblocking();
  port_ = ntohs(address.sin_port);
}

std::string TcpHostPort::address() const { return "localhost:" + std::to_string(port_); }

std::size_t TcpHostPort::read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) {
  std::array<pollfd, 2> waiting{{{listener_.get(), POLLIN, 0}, {host_.get(), POLLIN, 0}}};
  const timespec time{timeout.count() / 1000000, timeout.count() % 1000000 * 1000};
  if (::ppoll(waiting.data(), host_.valid() ? 2 : 1, &time, nullptr) <= 0) {
    return 0;
  }
  if (waiting[0].revents != 0) {
    accept_host();
    return 0;
  }
  return read_connection(host_, bytes);
}

void TcpHostPort::write(std::span<const std::uint8_t> bytes) { write_connection(host_, bytes); }

void TcpHostPort::accept_host() {
  FileDescriptor host(::accept(listener_.get(), nullptr, nullptr));
  if (!host.valid()) {
    return;
  }
  set_up_connection(host);
  host_ = std::move(host);
  ++connections_;
}

std::unique_ptr<HostPort> listen_on_tcp_port(std::uint16_t port) {
  return std::make_unique<TcpHostPort>(port);
}

std::unique_ptr<HostPort> connect_to_tcp_port(const std::string& host,
                                              std::vector<std::uint8_t> greeting) {
  return std::make_unique<TcpDialler>(host, std::move(greeting));
}

}  // namespace handway::device
