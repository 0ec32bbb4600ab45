#pragma once

#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace handway::device {

/// Kind of a record that a Polhemus tracker sends.
enum class PolhemusRecordKind {
  kPose,      ///< A station's pose.
  kDoubtful,  ///< A pose that the device marks as bad: distorted, or out of the field.
  kReply,     ///< An answer to another command: a sign of life.
};

/// One record from a Polhemus tracker.
struct PolhemusRecord {
  PolhemusRecordKind kind = PolhemusRecordKind::kPose;
  int station = 0;                                     ///< From 1.
  char command = 0;                                    ///< For kReply: the command it answers.
  char error = ' ';                                    ///< For kDoubtful: the device's letter.
  geometric::Pose X_ST = geometric::Pose::Identity();  ///< For kPose: sensor in source frame, m.
  std::optional<bool> button;                          ///< For kPose, if in the output list.
  std::optional<double> unit_time;  ///< For kPose, if in the output list: the unit's clock, s.
  std::vector<std::uint8_t> body;   ///< For kReply.
};

/// Verdict on the bytes at a place of a stream.
template <typename Record>
struct ScanVerdict {
  /// Bytes of a complete record; 0: an incomplete one so far; nothing: no record.
  std::optional<std::size_t> length;
  Record record;  ///< Valid for a whole record.
};

/// Finds records in a stream of bytes. Other bytes are dropped one by one until a record begins, so
/// that a record behind any garbage is found.
template <typename Record>
class RecordScanner {
 public:
  /// @param classify returns the ScanVerdict of a span of bytes; a verdict other than "incomplete
  /// so far" must not change when more bytes follow.
  template <typename Classify>
  std::vector<Record> scan(std::span<const std::uint8_t> bytes, const Classify& classify) {
    pending_.insert(pending_.end(), bytes.begin(), bytes.end());
    std::vector<Record> records;
    std::size_t at = 0;
    while (at < pending_.size()) {
      ScanVerdict<Record> verdict = classify(std::span<const std::uint8_t>(pending_).subspan(at));
      if (verdict.length == std::size_t{0}) {
        break;
      }
      if (verdict.length) {
        records.push_back(std::move(verdict.record));
        at += *verdict.length;
      } else {
        ++dropped_bytes_;
        resynchronisations_ += in_sync_ ? 1 : 0;
        ++at;
      }
      in_sync_ = verdict.length.has_value();
    }
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(at));
    return records;
  }

  /// Discards the beginning of an incomplete record.
  void reset() { pending_.clear(); }

  /// Number of resynchronisations, and the bytes dropped by them.
  [[nodiscard]] std::uint64_t resynchronisations() const { return resynchronisations_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return dropped_bytes_; }

 private:
  std::vector<std::uint8_t> pending_;  ///< At most a record's beginning between two calls.
  std::uint64_t resynchronisations_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  bool in_sync_ = true;
};

/// Items of a data record, in order, by the manufacturer's numbers.
using OutputList = std::vector<int>;

/// Layout of a Fastrak's data record: '0', the station's digit, an error letter (blank if good),
/// then the items of the output list.
struct HANDWAY_DEVICE_EXPORT FastrakFormat {
  /// 0 a blank, 1 CR LF, 2 position, 4 azimuth, elevation and roll, 11 quaternion (w x y z),
  /// 16 stylus switch.
  OutputList items{2, 11, 0};
  bool binary = true;        ///< 32-bit little-endian floats instead of fixed-width text.
  bool centimetres = false;  ///< Instead of inches.

  /// Bytes of a complete record: 32 for the binary list 2,11,0; 47 for the ASCII list 2,4,1.
  [[nodiscard]] std::size_t record_length() const;
};

/// Layout of the body of a Liberty's binary data record, after a header of 8 bytes.
struct HANDWAY_DEVICE_EXPORT LibertyFormat {
  /// 0 a blank, 1 CR LF, 2 or 3 position, 4 azimuth, elevation and roll, 7 quaternion (w x y z),
  /// 8 time stamp (ms), 9 frame count, 10 stylus switch, 11 distortion.
  OutputList items{8, 9, 11, 3, 7};
  bool centimetres = false;  ///< Instead of inches.

  /// Bytes of a data record's body: 40 for the list 8,9,11,3,7.
  [[nodiscard]] std::size_t body_length() const;
};

/// Cuts the bytes of a Polhemus tracker into data and status records. Records that don't have
/// exactly the right form, are not finite, farther than 10 m, or have no unit quaternion are
/// dropped, never repaired; a record behind them is found.
/// @tparam Format FastrakFormat (source: Polhemus 3SPACE Fastrak user's manual, revision G), or
/// LibertyFormat for the binary records of Liberty ("LY"), Patriot ("PA") and Latus ("LU").
template <typename Format>
class HANDWAY_DEVICE_EXPORT PolhemusParser {
 public:
  /// @throws std::invalid_argument if the list has an item unknown to the format, no position or no
  /// orientation.
  explicit PolhemusParser(Format format);

  /// Takes the next bytes. @returns the records that they complete.
  std::vector<PolhemusRecord> push(std::span<const std::uint8_t> bytes);

  /// Discards the beginning of an incomplete record.
  void reset() { scanner_.reset(); }

  /// Number of resynchronisations, and the bytes dropped by them.
  [[nodiscard]] std::uint64_t resynchronisations() const { return scanner_.resynchronisations(); }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return scanner_.dropped_bytes(); }

 private:
  Format format_;
  RecordScanner<PolhemusRecord> scanner_;
};

extern template class PolhemusParser<FastrakFormat>;
extern template class PolhemusParser<LibertyFormat>;

/// Parser of the records of a Fastrak.
using FastrakParser = PolhemusParser<FastrakFormat>;
/// Parser of the records of a Liberty.
using LibertyParser = PolhemusParser<LibertyFormat>;

}  // namespace handway::device
