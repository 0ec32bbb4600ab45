#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/polhemus_record.h"
#include "handway/device/tracker/record_scanner.h"

#include <span>
#include <vector>

namespace handway::device {

/// What a Fastrak puts into a data record: '0', the station's digit, an error letter (blank if
/// good), then the items of the output list.
struct FastrakFormat {
  /// 0 a blank, 1 CR LF, 2 position, 4 azimuth, elevation and roll, 11 quaternion (w x y z),
  /// 16 stylus switch.
  std::vector<int> items{2, 11, 0};
  bool binary = true;        ///< 32-bit little-endian floats instead of fixed-width text.
  bool centimetres = false;  ///< Instead of inches.

  /// Bytes of a whole record: 32 for the binary list 2,11,0; 47 for the ASCII list 2,4,1.
  [[nodiscard]] HANDWAY_DEVICE_EXPORT std::size_t record_length() const;
};

/// Cuts the bytes of a Polhemus Fastrak into data and status records. What doesn't have exactly
/// the form of a record, is not finite, farther than 10 m, or has no unit quaternion is
/// dropped, never guessed at; a record behind it is found.
/// Source: Polhemus 3SPACE Fastrak user's manual, revision G.
class HANDWAY_DEVICE_EXPORT FastrakParser {
 public:
  /// @throws std::invalid_argument if the list has an item not named above, no position or no
  /// orientation.
  explicit FastrakParser(FastrakFormat format);

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

  FastrakFormat format_;
  RecordScanner<PolhemusRecord> scanner_;
};

}  // namespace handway::device
