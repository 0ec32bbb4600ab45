#pragma once

#include "handway/device/export.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <variant>

namespace handway::device {

/// A serial port, or a pseudo-terminal in its place.
struct SerialAddress {
  std::string path;  ///< "/dev/ttyUSB0".
};

/// A TCP port, as of a serial-to-network converter.
struct TcpAddress {
  std::string host;  ///< Name or number; an IPv6 number without its brackets.
  std::uint16_t port = 0;
};

/// Address of a device: a serial port or a TCP port.
using DeviceAddress = std::variant<SerialAddress, TcpAddress>;

/// Reads "HOST:PORT" or "tcp://HOST:PORT" as a TCP port, everything else as a serial port's path.
/// @throws geometric::InputError if `text` is empty or the port is no number from 1 to 65535.
[[nodiscard]] HANDWAY_DEVICE_EXPORT DeviceAddress parse_device_address(const std::string& text);

/// Reads "HOST[:PORT]".
/// @throws geometric::InputError as parse_device_address().
[[nodiscard]] HANDWAY_DEVICE_EXPORT TcpAddress parse_host_and_port(const std::string& text,
                                                                   std::uint16_t default_port);

/// A two-way stream of bytes to a device: a serial port or a TCP connection.
/// To be used by one thread at a time.
class HANDWAY_DEVICE_EXPORT ByteLink {
 public:
  virtual ~ByteLink() = default;
  ByteLink(const ByteLink&) = delete;
  ByteLink& operator=(const ByteLink&) = delete;

  /// Name as the user wrote it.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Waits for bytes and reads the available ones.
  /// @returns the number of bytes at the front of `bytes`; 0 after `timeout` without any.
  /// @throws DeviceError if the other end is gone.
  std::size_t read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout);

  /// Sends all of `bytes`.
  /// @throws DeviceError if the other end is gone or has not taken them within `timeout`.
  void write(std::span<const std::uint8_t> bytes,
             std::chrono::milliseconds timeout = kLongestWrite);

  static constexpr std::chrono::milliseconds kLongestWrite{1000};
  /// Time limit of commands, which are short: a device that does not take one does not read at all,
  /// and the other devices have to be notified.
  static constexpr std::chrono::milliseconds kLongestCommand{100};

 protected:
  explicit ByteLink(std::string name) : name_(std::move(name)) {}

 private:
  virtual std::size_t do_read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout) = 0;
  virtual void do_write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds timeout) = 0;

  std::string name_;
};

/// Opens a serial port (8 data bits, no parity, 1 stop bit, no flow control) or connects to a
/// TCP port (see parse_device_address()); with "listen://PORT" waits until a device connects to
/// that port of this computer, as one with WiFi does.
/// @param baud of a serial port, bit/s.
/// @throws geometric::InputError for a wrong address; DeviceError if the device is missing, can't
/// be opened, is no serial port, or within 2 s no server answers or within 60 s no client connects.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<ByteLink> open_link(
    const std::string& address, int baud, const std::stop_token& stop = {});

}  // namespace handway::device
