#include "handway_test/flooding_proxy.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace handway::test {
namespace {

constexpr int kTickMs = 1;
constexpr std::size_t kPiece = std::size_t{256} * 1024;

sockaddr_in local(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

int connect_to(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = local(port);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(fd);
    return -1;
  }
  return fd;
}

void close_both(int& host, int& device) {
  ::close(host);
  ::close(device);
  host = -1;
  device = -1;
}

/// Passes on the bytes that are there. @param to -1: none. @returns it; nothing if one end is gone.
std::optional<std::string> pass(int from, int to) {
  std::string bytes(65536, '\0');
  const ssize_t count = ::recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count == 0 || (count < 0 && errno != EAGAIN)) {
    return std::nullopt;
  }
  bytes.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
  if (to >= 0 && ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) {
    return std::nullopt;
  }
  return bytes;
}

}  // namespace

FloodingProxy::FloodingProxy(std::uint16_t device, std::uint16_t port)
    : device_(device), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int on = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_in address = local(port);
  socklen_t size = sizeof(address);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener_, generic, size) != 0 || ::listen(listener_, 1) != 0 ||
      ::getsockname(listener_, generic, &size) != 0) {
    ::close(listener_);
    throw std::runtime_error("no free TCP port");
  }
  port_ = ntohs(address.sin_port);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

FloodingProxy::~FloodingProxy() {
  thread_.request_stop();
  thread_.join();
  ::close(listener_);
}

void FloodingProxy::flood(const std::string& message) {
  std::string piece;
  while (piece.size() < kPiece) {
    piece += message;
  }
  const std::lock_guard lock(mutex_);
  flood_ = std::move(piece);
}

void FloodingProxy::flood() {
  std::string last;
  {
    const std::lock_guard lock(mutex_);
    last = last_;
  }
  flood(last);
}

void FloodingProxy::run(const std::stop_token& stop) {
  int host = -1;
  int device = -1;
  std::size_t sent = 0;  // of the flood's piece
  std::string flood;
  while (!stop.stop_requested()) {
    if (host < 0) {
      pollfd waiting{listener_, POLLIN, 0};
      if (::poll(&waiting, 1, kTickMs) <= 0) {
        continue;
      }
      host = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      device = connect_to(device_);
      sent = 0;
      if (device < 0) {
        close_both(host, device);
      }
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      if (flood.empty() && !flood_.empty()) {
        flood = flood_;
      }
    }
    const short of_host = static_cast<short>((reads_ ? POLLIN : 0) | (flood.empty() ? 0 : POLLOUT));
    std::array<pollfd, 2> waiting{{{host, of_host, 0}, {device, POLLIN, 0}}};
    ::poll(waiting.data(), waiting.size(), kTickMs);
    bool alive = true;
    if ((waiting[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      alive = pass(host, device).has_value();
    }
    if (alive && (waiting[1].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      const auto sent_last = pass(device, flood.empty() ? host : -1);
      alive = sent_last.has_value();
      if (alive && !sent_last->empty()) {
        const std::lock_guard lock(mutex_);
        last_ = *sent_last;
      }
    }
    if (alive && (waiting[0].revents & POLLOUT) != 0) {
      const std::string_view rest = std::string_view(flood).substr(sent);
      const ssize_t count = ::send(host, rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      alive = count >= 0 || errno == EAGAIN;
      if (count > 0) {
        flooded_ += static_cast<std::uint64_t>(count);
        sent = (sent + static_cast<std::size_t>(count)) % flood.size();
      }
    }
    if (!alive) {
      close_both(host, device);
    }
  }
  if (host >= 0) {
    close_both(host, device);
  }
}

std::uint16_t port_of(const std::string& address) {
  return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

FloodingArmProxy::FloodingArmProxy(std::uint16_t device) {
  constexpr int kAttempts = 50;
  constexpr std::uint16_t kStatePortOffset = 2;
  for (int attempt = 1;; ++attempt) {
    motion = std::make_unique<FloodingProxy>(device);
    try {
      state = std::make_unique<FloodingProxy>(
          static_cast<std::uint16_t>(device + kStatePortOffset),
          static_cast<std::uint16_t>(motion->port() + kStatePortOffset));
      return;
    } catch (const std::runtime_error&) {
      if (attempt == kAttempts) {
        throw;
      }
    }
  }
}

}  // namespace handway::test
