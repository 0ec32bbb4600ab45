#pragma once

#include "handway/device/core/byte_link.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

struct sockaddr_in;  // NOLINT(readability-identifier-naming): the name of the system

namespace handway::device {

/// Owns a file descriptor of the system.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }

  void close() {
    if (fd_ >= 0) {
      ::close(std::exchange(fd_, -1));
    }
  }

  /// Reads and writes return at once, and programs started later don't inherit it.
  void make_nonblocking() const {
    ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) | O_NONBLOCK);
    ::fcntl(fd_, F_SETFD, FD_CLOEXEC);
  }

  /// Waits for readable bytes. @returns whether there are any.
  [[nodiscard]] bool wait_readable(std::chrono::microseconds timeout) const {
    pollfd waiting{fd_, POLLIN, 0};
    const timespec time{timeout.count() / 1000000, timeout.count() % 1000000 * 1000};
    return ::ppoll(&waiting, 1, &time, nullptr) > 0;
  }

 private:
  int fd_;
};

/// The device's end of a line, for emulators: a pseudo-terminal or a listening TCP port.
class HostPort {
 public:
  virtual ~HostPort() = default;
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;

  /// Address for a host to open.
  [[nodiscard]] virtual std::string address() const = 0;

  /// Waits for bytes from a host, at most `timeout`. @returns how many there are.
  virtual std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) = 0;

  /// Sends the bytes that a host accepts; the rest is lost, as on a line without flow control.
  virtual void write(std::span<const std::uint8_t> bytes) = 0;

 protected:
  HostPort() = default;
};

/// @throws DeviceError if the system has no pseudo-terminals.
[[nodiscard]] std::unique_ptr<HostPort> open_pseudo_terminal();

/// Listens on this computer only. @param port 0: any free one.
/// @throws DeviceError if the port is taken or not allowed.
[[nodiscard]] std::unique_ptr<HostPort> listen_on_tcp_port(std::uint16_t port);

/// Connects to "HOST:PORT", with retries until a server listens there, and sends `greeting`
/// first.
/// @throws geometric::InputError for a wrong address; DeviceError if the host does not exist.
[[nodiscard]] std::unique_ptr<HostPort> connect_to_tcp_port(const std::string& host,
                                                            std::vector<std::uint8_t> greeting);

/// Sends every record as a datagram to "HOST:PORT", with or without a receiver; receives
/// nothing.
/// @throws geometric::InputError for a wrong address; DeviceError if the host does not exist.
[[nodiscard]] std::unique_ptr<HostPort> send_to_udp_port(const std::string& receiver);

/// A TCP port of this computer to which one host at a time may connect; a new connection replaces
/// the last.
class TcpHostPort final : public HostPort {
 public:
  /// @param port 0: any free one.
  /// @throws DeviceError if the port is taken or not allowed.
  explicit TcpHostPort(std::uint16_t port);

  [[nodiscard]] std::string address() const override;
  std::size_t read(std::span<std::uint8_t> bytes, std::chrono::microseconds timeout) override;
  void write(std::span<const std::uint8_t> bytes) override;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Number of hosts that have connected so far.
  [[nodiscard]] int connections() const { return connections_; }
  [[nodiscard]] bool connected() const { return host_.valid(); }
  void disconnect() { host_.close(); }

 private:
  void accept_host();

  FileDescriptor listener_;
  FileDescriptor host_;
  std::uint16_t port_ = 0;
  int connections_ = 0;
};

/// Detects that a port's host is gone, or was replaced.
class HostWatch {
 public:
  explicit HostWatch(const TcpHostPort& port) : port_(port) {}

  /// True if the host of the last call is not connected any more.
  [[nodiscard]] bool lost() {
    const bool gone = connected_ && (!port_.connected() || port_.connections() != connections_);
    connections_ = port_.connections();
    connected_ = port_.connected();
    return gone;
  }

 private:
  const TcpHostPort& port_;
  int connections_ = 0;
  bool connected_ = false;
};

/// Queue of an emulated device's output until it is due, in order.
class DelayedBytes {
 public:
  /// @param due s, by the clock of send().
  void add(std::vector<std::uint8_t> bytes, double due) {
    waiting_.emplace_back(due, std::move(bytes));
  }
  void clear() { waiting_.clear(); }

  /// Next time for send(), s; nothing if nothing waits.
  [[nodiscard]] std::optional<double> next_due() const {
    return waiting_.empty() ? std::nullopt : std::optional(waiting_.front().first);
  }

  void send(HostPort& port, double now) {
    while (!waiting_.empty() && waiting_.front().first <= now) {
      port.write(waiting_.front().second);
      waiting_.pop_front();
    }
  }

 private:
  std::deque<std::pair<double, std::vector<std::uint8_t>>> waiting_;
};

/// Reads "HOST:PORT", or "PORT" for this computer.
/// @throws geometric::InputError as parse_device_address().
[[nodiscard]] TcpAddress parse_udp_address(const std::string& text);

/// @param name as the user wrote the address.
/// @throws DeviceError if the host is not known.
[[nodiscard]] sockaddr_in resolve_ipv4(const std::string& name, const TcpAddress& address);

/// A UDP port that receives datagrams.
class UdpReceiver {
 public:
  /// @throws DeviceError if the port is taken or not allowed, or the host isn't this computer.
  UdpReceiver(const std::string& name, const TcpAddress& address);

  /// Waits for a datagram. @returns its length, of which the part that fits is in `bytes`; nothing
  /// after `timeout` without one.
  [[nodiscard]] std::optional<std::size_t> receive(std::span<std::uint8_t> bytes,
                                                   std::chrono::microseconds timeout);

 private:
  FileDescriptor socket_;
};

}  // namespace handway::device
