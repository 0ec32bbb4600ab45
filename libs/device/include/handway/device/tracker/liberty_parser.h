#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/polhemus_record.h"
#include "handway/device/tracker/record_scanner.h"

#include <span>
#include <vector>

namespace handway::device {

/// What a Liberty puts into the body of a binary data record, after a header of 8 bytes.
struct LibertyFormat {
  /// 0 a blank, 1 CR LF, 2 or 3 position, 4 azimuth, elevation and roll, 7 quaternion (w x y z),
  /// 8 time stamp (ms), 9 frame count, 10 stylus switch, 11 distortion.
  std::vector<int> items{8, 9, 11, 3, 7};
  bool centimetres = false;  ///< Instead of inches.

  /// Bytes of a data record's body: 40 for the list 8,9,11,3,7.
  [[nodiscard]] HANDWAY_DEVICE_EXPORT std::size_t body_length() const;
};

/// Cuts the bytes of a Polhemus Liberty ("LY"), Patriot ("PA") or Latus ("LU") into binary
/// records. Drops what FastrakParser drops.
class HANDWAY_DEVICE_EXPORT LibertyParser {
 public:
  /// @throws std::invalid_argument if the list has an item not named above, no position or no
  /// orientation.
  explicit LibertyParser(LibertyFormat format);

  /// Takes the next bytes. @returns the records that they complete.
  std::vector<PolhemusRecord> push(std::span<const std::uint8_t> bytes);

  /// Forgets the beginning of an incomplete record.
  void reset() { scanner_.reset(); }

  /// How many times it lost its place, and the bytes that it dropped then.
  [[nodiscard]] std::uint64_t resynchronisations() const { return scanner_.resynchronisations(); }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return scanner_.dropped_bytes(); }

 private:
  [[nodiscard]] ScanVerdict<PolhemusRecord> classify(std::span<const std::uint8_t> bytes) const;
  [[nodiscard]] ScanVerdict<PolhemusRecord> read_data(std::span<const std::uint8_t> bytes) const;

  LibertyFormat format_;
  RecordScanner<PolhemusRecord> scanner_;
};

}  // namespace handway::device
