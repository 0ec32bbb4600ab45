#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace handway::device {

/// What the bytes at a place of a stream are.
template <typename Record>
struct ScanVerdict {
  /// Bytes of a whole record; 0: the beginning of one so far; nothing: no record.
  std::optional<std::size_t> length;
  Record record;  ///< Of a whole record.
};

/// Finds records in a stream of bytes. What is none is dropped byte by byte until one begins, so
/// that a record behind any garbage is found.
template <typename Record>
class RecordScanner {
 public:
  /// @param classify gives the ScanVerdict of a span of bytes; a verdict other than "the
  /// beginning so far" must not change when more bytes follow.
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

  /// Forgets the beginning of an incomplete record.
  void reset() { pending_.clear(); }

  /// How many times it lost its place, and the bytes that it dropped then.
  [[nodiscard]] std::uint64_t resynchronisations() const { return resynchronisations_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const { return dropped_bytes_; }

 private:
  std::vector<std::uint8_t> pending_;  ///< At most a record's beginning between two calls.
  std::uint64_t resynchronisations_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  bool in_sync_ = true;
};

}  // namespace handway::device
