#include "tcp_host_port.h"

#include "handway/device/core/device_error.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace handway::device {

TcpHostPort::TcpHostPort(std::uint16_t port)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int on = 1;
  // So that an emulator that was killed can be started again on its port.
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
  const ssize_t count = ::read(host_.get(), bytes.data(), bytes.size());
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
    host_.close();
  }
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

void TcpHostPort::write(std::span<const std::uint8_t> bytes) {
  if (host_.valid() && ::send(host_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 &&
      errno != EAGAIN) {
    host_.close();
  }
}

void TcpHostPort::accept_host() {
  FileDescriptor host(::accept(listener_.get(), nullptr, nullptr));
  if (!host.valid()) {
    return;
  }
  host.make_nonblocking();
  const int on = 1;
  ::setsockopt(host.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  host_ = std::move(host);
  ++connections_;
}

std::unique_ptr<HostPort> listen_on_tcp_port(std::uint16_t port) {
  return std::make_unique<TcpHostPort>(port);
}

}  // namespace handway::device
