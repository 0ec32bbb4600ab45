#include "handway/device/haptic/haptic_device.h"

#include "core/links.h"
#include "handway/device/core/device_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <string_view>

namespace handway::device {
namespace {

constexpr std::chrono::milliseconds kLongestSilence{100};

}  // namespace

void HapticDevice::refuse(std::string found, std::string expected, std::string advice) const {
  throw DeviceError({name_, "", std::move(found), std::move(expected), std::move(advice)});
}

void HapticDevice::connect(const std::stop_token& stop) {
  abilities_ = do_connect(stop);
  watchdog_.heard(Watchdog::Clock::now());
  backlog_ = {};
}

std::optional<HapticSample> HapticDevice::read(std::chrono::milliseconds timeout) {
  try {
    const Reading reading = do_read(timeout);
    const auto now = Watchdog::Clock::now();
    backlog_.turn(reading.all, now);
    if (backlog_.lasted(now) > kLongestSilence) {
      refuse(fmt::format("more messages than can be read, for {} ms", kLongestSilence.count()),
             "a position every 10 ms or more often",
             "What it says is old by the time it is read: look at its program.");
    }
    if (reading.newest) {
      watchdog_.heard(now);
    } else if (watchdog_.listened(now) > kLongestSilence) {
      refuse(fmt::format("no position for {} ms", kLongestSilence.count()),
             "one every 10 ms or more often", "Look at the network and at the device.");
    }
    return reading.newest;
  } catch (...) {
    release();
    throw;
  }
}

void HapticDevice::apply(const Eigen::Vector3d& force) {
  const double strength = force.norm();
  if (!force.allFinite()) {
    do_apply(Eigen::Vector3d::Zero());
  } else if (strength > abilities_.force) {
    do_apply(force * (abilities_.force / strength));
  } else {
    do_apply(force);
  }
}

void HapticDevice::release() {
  try {
    do_apply(Eigen::Vector3d::Zero());
  } catch (const std::exception&) {
    // The connection is lost: the device's own watchdog ends the force.
    return;
  }
}

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
    link->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                ByteLink::kLongestCommand);
  }
  // Waits for bytes, and passes them to `take`, line by line. @returns as read_turn().
  template <typename Take>
  bool receive(milliseconds timeout, const Take& take) {
    return read_turn(*link, timeout, [&](std::span<const std::uint8_t> bytes) {
      lines.add(bytes);
      while (const auto line = lines.next()) {
        take(*line);
      }
    });
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
    std::optional<HapticAbilities> abilities;
    while (std::chrono::steady_clock::now() - begin < kLongestHello && !stop.stop_requested()) {
      // States may follow at once.
      static_cast<void>(wire_->receive(milliseconds(10), [&](const std::string& line) {
        if (!abilities) {
          abilities = parse_haptic_hello(line);
        }
      }));
      if (abilities) {
        return *abilities;
      }
    }
  } catch (const LineProtocolError& error) {
    refuse(error.what(), kExpected, kAdvice);
  }
  refuse("no answer to \"hello\"", kExpected, kAdvice);
}

HapticDevice::Reading NetworkHaptic::do_read(milliseconds timeout) {
  Reading reading;
  try {
    reading.all = wire_->receive(timeout, [&](const std::string& line) {
      if (line.starts_with("fault")) {
        refuse(quote(line.substr(std::min<std::size_t>(line.size(), 6))),
               "a device without a fault", "Look at the device.");
      }
      reading.newest = parse_haptic_state(line);
    });
  } catch (const LineProtocolError& error) {
    refuse(error.what(), kExpected, kAdvice);
  }
  return reading;
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
