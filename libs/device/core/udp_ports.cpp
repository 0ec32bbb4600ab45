#include "core/ports.h"
#include "handway/device/core/device_error.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace handway::device {
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

}  // namespace handway::device
