#pragma once

#include "handway/device/export.h"
#include "handway/geometric/io/parameter.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace handway::device {

/// The inside of an emulated device: takes a host's bytes and returns those that the device would
/// send. It has neither ports nor clocks, so that a test can run a day of it quickly;
/// DeviceEmulator connects it to a port. Times are in s and never fall.
class HANDWAY_DEVICE_EXPORT DeviceUnit {
 public:
  using Bytes = std::vector<std::uint8_t>;

  virtual ~DeviceUnit() = default;
  DeviceUnit& operator=(const DeviceUnit&) = delete;

  /// Takes bytes of the host. @returns the answer.
  [[nodiscard]] virtual Bytes receive(std::span<const std::uint8_t> bytes, double now) = 0;

  /// @returns the records that were due up to `now`, one per entry; at most those of a quarter of a
  /// second: a delayed unit doesn't send more.
  [[nodiscard]] virtual std::vector<Bytes> advance(double now) = 0;

  /// Time at which advance() returns something again; nothing if it waits for the host.
  [[nodiscard]] virtual std::optional<double> next_due() const = 0;

  /// Unplugs the sensing part (glove, sensors) from the unit, or plugs it in again.
  virtual void set_plugged(bool plugged) = 0;

 protected:
  DeviceUnit() = default;
  DeviceUnit(const DeviceUnit&) = default;
};

class SeededRandom;

/// Probability of each fault for one record, 0 to 1.
struct LineFaultSettings {
  double dropout = 0.0;  ///< The record is lost.
  double garbage = 0.0;  ///< The record is damaged: see LineFaults.
  std::uint64_t seed = 1;
};

/// Describes the settings but the seed.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    LineFaultSettings& settings);

/// Damages records as bad cables do: loses some whole, and damages others by one of a lost byte, a
/// doubled byte, a 00 inside, a missing end, random bytes in front. The same seed gives the same
/// faults.
class HANDWAY_DEVICE_EXPORT LineFaults {
 public:
  /// @throws std::invalid_argument if a probability is not from 0 to 1.
  explicit LineFaults(const LineFaultSettings& settings);
  ~LineFaults();

  /// @returns the part of `record` that arrives.
  [[nodiscard]] std::vector<std::uint8_t> apply(std::vector<std::uint8_t> record);

  /// Number of records so far that were lost or damaged.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  void damage(std::vector<std::uint8_t>& record);

  LineFaultSettings settings_;
  std::unique_ptr<SeededRandom> random_;
  std::uint64_t count_ = 0;
};

/// Faults, delay and outage of an emulated device.
struct DeviceEmulatorSettings {
  LineFaultSettings faults;         ///< Faults of streamed records; answers arrive whole.
  double latency = 0.0;             ///< Delay of everything that the unit sends, s.
  std::optional<double> unplug_at;  ///< DeviceUnit::set_plugged(false) so long after the start, s,
  std::optional<double> replug_at;  ///< and true again.
  /// A TCP port of this computer to listen on (0: any free one).
  std::optional<std::uint16_t> tcp_port;
  /// HOST:PORT to send every record to as a UDP datagram; it receives nothing then.
  std::optional<std::string> udp_receiver;
  /// HOST:PORT to connect to, as a device with WiFi does, and the first bytes to send.
  std::optional<std::string> tcp_server;
  std::vector<std::uint8_t> greeting;
};

/// An emulated device that programs can't distinguish from hardware: its unit on a pseudo-terminal
/// (if the settings name no port), run by a thread of its own. One host at a time; over TCP a new
/// connection replaces the last, as with serial-to-network converters.
class HANDWAY_DEVICE_EXPORT DeviceEmulator {
 public:
  /// Opens the port and starts. @pre `unit` is not null.
  /// @throws DeviceError if the port is taken or not allowed; std::invalid_argument for invalid
  /// settings.
  DeviceEmulator(const DeviceEmulatorSettings& settings, std::unique_ptr<DeviceUnit> unit);
  /// Closes the port at once, as if the cable were cut.
  ~DeviceEmulator();
  DeviceEmulator(const DeviceEmulator&) = delete;
  DeviceEmulator& operator=(const DeviceEmulator&) = delete;

  /// Address for a driver: "/dev/pts/4" or "localhost:5555"; for UDP the receiver.
  [[nodiscard]] const std::string& address() const;

  /// See DeviceUnit::set_plugged().
  void set_plugged(bool plugged);

  /// Number of records sent, lost and damaged ones included.
  [[nodiscard]] std::uint64_t records() const;
  /// Number of records lost or damaged.
  [[nodiscard]] std::uint64_t faults() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
