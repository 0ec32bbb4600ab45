#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::device {

/// Layout of a binary record of a CyberGlove interface unit: `G` ord: `G` or `S`, one byte a
/// sensor, optionally five of a time stamp and one of status, 00.
struct CyberGloveFormat {
  int sensors = kGloveSensors;  ///< 18 or 22.
  bool time_stamp = false;      ///< Flag D of the unit.
  bool status = false;          ///< Flag U of the unit.

  /// Bytes of a complete record, letter and closing 00 included: 24 for 22 sensors.
  [[nodiscard]] std::size_t record_length() const {
    return static_cast<std::size_t>(sensors) + 2 + (time_stamp ? 5 : 0) + (status ? 1 : 0);
  }
};

/// Kind of a record that a CyberGlove sends.
enum class CyberGloveRecordKind {
  kSample,          ///< One value of every sensor.
  kUnplugged,       ///< "eg": no glove on the interface unit.
  kTooFast,         ///< "es": the sampling rate is too high for glove or line.
  kSyncRate,        ///< "ey": the rate of the external sync input is wrong.
  kUnknownCommand,  ///< "e?".
  kStopped,         ///< The answer to Ctrl-C: no more samples come.
};

/// One record from the wire.
struct CyberGloveRecord {
  CyberGloveRecordKind kind = CyberGloveRecordKind::kSample;
  std::array<std::uint16_t, kGloveSensors> counts{};  ///< See GloveFrame; 0 if no sample.
  std::uint32_t time_stamp = 0;                       ///< The unit's clock; 0 if not in the format.
  std::uint8_t status = 0;  ///< Bit 0 glove plugged in, 1 switch, 2 light; 0 if not in the format.
};

/// Cuts the bytes of a CyberGlove into records. Only the last byte of a record is 00, so that
/// after any loss or noise on the line the next 00 synchronizes the parser again. Bytes that don't
/// have exactly the form of a record are dropped, never repaired. Takes no more memory than one
/// record.
class HANDWAY_DEVICE_EXPORT CyberGloveParser {
 public:
  /// @throws std::invalid_argument if the format has neither 18 nor 22 sensors.
  explicit CyberGloveParser(const CyberGloveFormat& format);

  /// Takes the next byte. @returns the record that it completes, if any.
  std::optional<CyberGloveRecord> push(std::uint8_t byte);

  /// Discards the beginning of an incomplete record.
  void reset();

  /// Number of resynchronisations, and the bytes dropped by them.
  [[nodiscard]] std::uint64_t resynchronisations() const { return resynchronisations_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return dropped_bytes_; }

 private:
  [[nodiscard]] std::optional<CyberGloveRecord> classify() const;
  [[nodiscard]] CyberGloveRecord sample() const;

  CyberGloveFormat format_;
  std::vector<std::uint8_t> pending_;  ///< Since the last 00, at most a record's bytes.
  std::uint64_t pending_length_ = 0;   ///< Bytes since the last 00, also those not kept.
  std::uint64_t resynchronisations_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  bool in_sync_ = true;
};

}  // namespace handway::device
