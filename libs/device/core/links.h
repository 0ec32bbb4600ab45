#pragma once

#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_error.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

namespace handway::device {

/// Returns the number of a port. @param text the address that has it, for messages.
/// @throws geometric::InputError if it is no number from 1 to 65535.
[[nodiscard]] std::uint16_t parse_port(const std::string& text, std::string_view port);

/// Opens a serial port. @throws DeviceError if that is not possible.
[[nodiscard]] std::unique_ptr<ByteLink> open_serial_link(const std::string& path, int baud);

/// Connects to a device. @param name as the user wrote the address.
/// @throws DeviceError if it does not answer.
[[nodiscard]] std::unique_ptr<ByteLink> open_tcp_link(const std::string& name,
                                                      const TcpAddress& address,
                                                      const std::stop_token& stop);

/// Waits until a device connects to `port` of this computer. @param name as the user wrote it.
/// @throws DeviceError if the port is taken, or none connects within a minute.
[[nodiscard]] std::unique_ptr<ByteLink> accept_tcp_link(const std::string& name, std::uint16_t port,
                                                        const std::stop_token& stop);

/// Thrown when a pipe's writer has ended.
class EndOfInput : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// Opens a named pipe for reading. It does not end when its writer does: another may follow.
/// @param name as the user wrote it. @throws DeviceError if there is no such pipe.
[[nodiscard]] std::unique_ptr<ByteLink> open_pipe_link(const std::string& name,
                                                       const std::string& path);

/// Opens the standard input for reading; read() throws EndOfInput at its end.
/// @throws DeviceError if it is closed.
[[nodiscard]] std::unique_ptr<ByteLink> open_standard_input(const std::string& name);

/// Limit of the bytes that one turn of a device's loop reads from one connection: a device that
/// sends without pause must not delay a stop or the other devices.
class ReadBudget {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::size_t kMostBytes = std::size_t{256} * 1024;
  static constexpr std::chrono::milliseconds kLongest{5};

  void spend(std::size_t bytes) { bytes_ += bytes; }
  [[nodiscard]] bool spent() const { return bytes_ >= kMostBytes || Clock::now() >= deadline_; }

 private:
  std::size_t bytes_ = 0;
  Clock::time_point deadline_ = Clock::now() + kLongest;
};

/// Reads pending bytes of a link, within a ReadBudget that begins with the first bytes.
/// @param wait for the first bytes.
/// @param take is called with each piece, a span of bytes that is never empty. Its exceptions end
/// the turn.
/// @returns whether all pending bytes were read; false: more are waiting than one turn may take.
/// @throws DeviceError if the other end is gone.
template <typename Take>
bool read_turn(ByteLink& link, std::chrono::milliseconds wait, Take&& take) {
  std::array<std::uint8_t, 4096> bytes{};
  std::size_t count = link.read(bytes, wait);
  ReadBudget budget;
  while (count > 0) {
    take(std::span<const std::uint8_t>(bytes).first(count));
    budget.spend(count);
    if (count < bytes.size()) {
      return true;
    }
    if (budget.spent()) {
      return false;
    }
    count = link.read(bytes, std::chrono::milliseconds(0));
  }
  return true;
}

}  // namespace handway::device
