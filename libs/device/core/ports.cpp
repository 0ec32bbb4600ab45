#include "core/ports.h"

#include "handway/device/core/device_error.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pty.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

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

namespace {

class PseudoTerminal final : public HostPort {
 public:
  PseudoTerminal() {
    int master = -1;
    int slave = -1;
    std::array<char, 256> name{};
    if (::openpty(&master, &slave, name.data(), nullptr, nullptr) != 0) {
      throw DeviceError({"pseudo-terminal", "", std::strerror(errno), "a free pseudo-terminal",
                         "Close other terminals, or use a TCP port."});
    }
    master_ = FileDescriptor(master);
    slave_ = FileDescriptor(slave);
    address_ = name.data();
    master_.make_nonblocking();
    slave_.make_nonblocking();
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::cfsetspeed(&raw, B115200);
    ::tcsetattr(slave, TCSANOW, &raw);
  }

  [[nodiscard]] std::string address() const override { return address_; }

  std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) override {
    if (!master_.wait_readable(timeout)) {
      return 0;
    }
    return static_cast<std::size_t>(
        std::max<ssize_t>(::read(master_.get(), bytes.data(), bytes.size()), 0));
  }

  void write(std::span<const std::uint8_t> bytes) override {
    // Bytes that the port does not take are lost.
    [[maybe_unused]] const ssize_t taken = ::write(master_.get(), bytes.data(), bytes.size());
  }

 private:
  FileDescriptor master_;
  FileDescriptor slave_;  ///< Kept open, so that the port stays when a host closes it.
  std::string address_;
};

}  // namespace

std::unique_ptr<HostPort> open_pseudo_terminal() { return std::make_unique<PseudoTerminal>(); }

namespace {

FileDescriptor open_socket() {
  return FileDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
}

class UdpSender final : public HostPort {
 public:
  explicit UdpSender(const std::string& receiver) : address_(receiver), socket_(open_socket()) {
    const sockaddr_in address = resolve_ipv4(receiver, parse_udp_address(receiver));
    if (::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) !=
        0) {
      throw DeviceError({receiver, "", std::strerror(errno), "a host that can be reached",
                         "Look whether the network is up."});
    }
    socket_.make_nonblocking();
  }

  [[nodiscard]] std::string address() const override { return address_; }

  std::size_t read(std::span<std::uint8_t> /*bytes*/, std::chrono::microseconds timeout) override {
    std::this_thread::sleep_for(timeout);
    return 0;
  }

  void write(std::span<const std::uint8_t> bytes) override {
    // Datagrams that can't be sent are lost.
    [[maybe_unused]] const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), 0);
  }

 private:
  std::string address_;
  FileDescriptor socket_;
};

}  // namespace

TcpAddress parse_udp_address(const std::string& text) {
  const bool port_only = !text.empty() && text.find(':') == std::string::npos;
  const DeviceAddress address =
      parse_device_address("tcp://" + (port_only ? "localhost:" + text : text));
  return std::get<TcpAddress>(address);
}

sockaddr_in resolve_ipv4(const std::string& name, const TcpAddress& address) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(address.host.c_str(), nullptr, &hints, &found); error != 0) {
    throw DeviceError({name, "", std::string("unknown host: ") + ::gai_strerror(error),
                       "a host's name or its number", "Look whether it is spelled right."});
  }
  sockaddr_in resolved{};
  std::memcpy(&resolved, found->ai_addr, sizeof(resolved));
  ::freeaddrinfo(found);
  resolved.sin_port = htons(address.port);
  return resolved;
}

UdpReceiver::UdpReceiver(const std::string& name, const TcpAddress& address)
    : socket_(open_socket()) {
  const sockaddr_in bound = resolve_ipv4(name, address);
  if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&bound), sizeof(bound)) != 0) {
    throw DeviceError({name, "", std::strerror(errno), "a UDP port of this computer that is free",
                       "End the program that uses it, or take another port."});
  }
  socket_.make_nonblocking();
}

std::optional<std::size_t> UdpReceiver::receive(std::span<std::uint8_t> bytes,
                                                std::chrono::microseconds timeout) {
  if (!socket_.wait_readable(std::max(timeout, std::chrono::microseconds(0)))) {
    return std::nullopt;
  }
  const ssize_t length = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_TRUNC);
  return length < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(length));
}

std::unique_ptr<HostPort> send_to_udp_port(const std::string& receiver) {
  return std::make_unique<UdpSender>(receiver);
}

namespace {

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

std::unique_ptr<HostPort> connect_to_tcp_port(const std::string& host,
                                              std::vector<std::uint8_t> greeting) {
  return std::make_unique<TcpDialler>(host, std::move(greeting));
}

}  // namespace handway::device
