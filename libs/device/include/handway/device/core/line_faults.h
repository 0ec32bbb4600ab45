#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace handway::device {

class SeededRandom;

/// How likely each fault is for one record, 0 to 1.
struct LineFaultSettings {
  double dropout = 0.0;  ///< The record is lost.
  double garbage = 0.0;  ///< The record is damaged: see LineFaults.
  std::uint64_t seed = 1;
};

/// Does to records what bad cables do: loses some whole, and damages others by one of a lost
/// byte, a doubled byte, a 00 inside, a missing end, random bytes in front. The same seed gives
/// the same faults.
class HANDWAY_DEVICE_EXPORT LineFaults {
 public:
  /// @throws std::invalid_argument if a probability is not from 0 to 1.
  explicit LineFaults(const LineFaultSettings& settings);
  ~LineFaults();

  /// @returns what of `record` arrives.
  [[nodiscard]] std::vector<std::uint8_t> apply(std::vector<std::uint8_t> record);

  /// Records so far that were lost or damaged.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  void damage(std::vector<std::uint8_t>& record);

  LineFaultSettings settings_;
  std::unique_ptr<SeededRandom> random_;
  std::uint64_t count_ = 0;
};

}  // namespace handway::device
