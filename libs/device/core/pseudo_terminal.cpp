#include "core/ports.h"
#include "handway/device/core/device_error.h"

#include <pty.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

namespace handway::device {
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

}  // namespace handway::device
