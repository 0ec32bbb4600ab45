#include "handway/device/haptic/network_haptic.h"

#include "core/links.h"
#include "handway/device/core/device_error.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace handway::device {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLongestHello{1000};
constexpr std::string_view kScheme = "haptic://";
constexpr const char* kExpected = "a device that speaks Handway's haptic protocol";
constexpr const char* kAdvice = "Look whether the port is right.";

}  // namespace

struct NetworkHaptic::Wire {
  TcpAddress address;
  std::unique_ptr<ByteLink> link;
  LineBuffer lines;

  void send(std::string_view text) const {
    link->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  // Waits for bytes, and takes all that are there.
  void receive(milliseconds timeout) {
    std::array<std::uint8_t, 4096> bytes{};
    std::size_t count = link->read(bytes, timeout);
    lines.add(std::span(bytes).first(count));
    while (count == bytes.size()) {
      count = link->read(bytes, milliseconds(1));
      lines.add(std::span(bytes).first(count));
    }
  }
};

NetworkHaptic::NetworkHaptic(std::string name, std::string host, std::uint16_t port)
    : HapticDevice(std::move(name)), wire_(std::make_unique<Wire>()) {
  wire_->address = {std::move(host), port};
}

NetworkHaptic::~NetworkHaptic() = default;

HapticAbilities NetworkHaptic::do_connect(const std::stop_token& stop) {
  wire_->link.reset();
  wire_->link = open_tcp_link(name(), wire_->address, stop);
  wire_->lines = {};
  wire_->send(fmt::format("hello {}\n", kHapticProtocolVersion));
  const auto begin = std::chrono::steady_clock::now();
  try {
    while (std::chrono::steady_clock::now() - begin < kLongestHello && !stop.stop_requested()) {
      wire_->receive(milliseconds(10));
      if (const auto line = wire_->lines.next()) {
        return parse_haptic_hello(*line);
      }
    }
  } catch (const LineProtocolError& error) {
    refuse(error.what(), kExpected, kAdvice);
  }
  refuse("no answer to \"hello\"", kExpected, kAdvice);
}

std::optional<HapticSample> NetworkHaptic::do_read(milliseconds timeout) {
  std::optional<HapticSample> newest;
  try {
    wire_->receive(timeout);
    while (const auto line = wire_->lines.next()) {
      if (line->starts_with("fault")) {
        refuse(line->substr(std::min<std::size_t>(line->size(), 6)), "a device without a fault",
               "Look at the device.");
      }
      newest = parse_haptic_state(*line);
    }
  } catch (const LineProtocolError& error) {
    refuse(error.what(), kExpected, kAdvice);
  }
  return newest;
}

void NetworkHaptic::do_apply(const Eigen::Vector3d& force) {
  if (wire_->link) {
    wire_->send(force_line(force));
  }
}

std::unique_ptr<HapticDevice> make_haptic_device(const std::string& address) {
  const std::string where =
      address.starts_with(kScheme) ? address.substr(kScheme.size()) : std::string();
  if (where.empty()) {
    throw geometric::InputError({"--to", "", fmt::format("\"{}\"", address), "haptic://HOST[:PORT]",
                                 "Write, for example, haptic://localhost."});
  }
  const TcpAddress found = parse_host_and_port(where, kHapticPort);
  return std::make_unique<NetworkHaptic>(address, found.host, found.port);
}

}  // namespace handway::device
