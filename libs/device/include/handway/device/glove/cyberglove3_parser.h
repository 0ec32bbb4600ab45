#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/cyberglove_parser.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::device {

/// Cuts the native stream of a CyberGlove III into records of 61 bytes: a time stamp in 14
/// characters (HH:MM:SS:ff:nS), 22 sensors in two bytes each, most significant first, of which 12
/// bits count, then 0D 0A 00. Counts are scaled to the 8 bits of the other gloves (value / 16), as
/// the maker's calibration does.
///
/// No byte of a sensor can be confused with the time stamp's colons and digits, so that a
/// record is found again after any loss; other bytes are dropped. Takes no more memory than one
/// record.
///
/// Source: two programs for the glove, the ROS driver of Shadow Robot and the Python driver
/// `cyberglove`. It is unknown whether 0D 0A 00 ends a record or begins the next, so the parser
/// waits for it.
class HANDWAY_DEVICE_EXPORT CyberGlove3Parser {
 public:
  static constexpr std::size_t kRecordLength = 61;

  CyberGlove3Parser() { pending_.reserve(kRecordLength); }

  /// Takes the next byte. @returns the record that it completes, if any: always a sample.
  std::optional<CyberGloveRecord> push(std::uint8_t byte);

  /// Number of resynchronisations, and the bytes dropped by them.
  [[nodiscard]] std::uint64_t resynchronisations() const { return resynchronisations_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return dropped_bytes_; }

 private:
  void drop_to_next_beginning();
  [[nodiscard]] CyberGloveRecord sample() const;

  std::vector<std::uint8_t> pending_;  ///< Always the beginning of a record.
  std::uint64_t resynchronisations_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  bool in_sync_ = true;
};

}  // namespace handway::device
