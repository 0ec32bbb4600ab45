#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace handway::device {

/// The inside of an emulated device: takes the bytes that a host sends and gives those that the
/// device would. Knows neither ports nor clocks, so that a test can run a day of it in a
/// moment; DeviceEmulator puts it on a port. Times are in s and never fall.
class HANDWAY_DEVICE_EXPORT DeviceUnit {
 public:
  using Bytes = std::vector<std::uint8_t>;

  virtual ~DeviceUnit() = default;
  DeviceUnit& operator=(const DeviceUnit&) = delete;

  /// Takes what the host sent. @returns the answer.
  [[nodiscard]] virtual Bytes receive(std::span<const std::uint8_t> bytes, double now) = 0;

  /// @returns the records that were due up to `now`, one an entry; not more than a quarter of a
  /// second's worth, a unit that was held up doesn't make up for more.
  [[nodiscard]] virtual std::vector<Bytes> advance(double now) = 0;

  /// When advance() has something to give again; nothing if it waits for the host.
  [[nodiscard]] virtual std::optional<double> next_due() const = 0;

  /// Pulls what measures (glove, sensors) off the unit, or puts it back on.
  virtual void set_plugged(bool plugged) = 0;

 protected:
  DeviceUnit() = default;
  DeviceUnit(const DeviceUnit&) = default;
};

}  // namespace handway::device
