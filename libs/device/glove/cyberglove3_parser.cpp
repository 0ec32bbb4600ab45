#include "handway/device/glove/cyberglove3_parser.h"

#include <algorithm>
#include <span>
#include <string_view>

namespace handway::device {
namespace {

// The zeros stand for digits.
constexpr std::string_view kTimeStamp = "00:00:00:00:0S";
constexpr std::string_view kEnd("\r\n\0", 3);
constexpr std::size_t kValues = kTimeStamp.size();
constexpr std::size_t kEndAt = kValues + std::size_t{2} * kGloveSensors;
constexpr std::uint8_t kHighBits = 0x0F;  // High bits of the 12.

static_assert(kEndAt + kEnd.size() == CyberGlove3Parser::kRecordLength);

// Returns whether the last of these bytes fits after the others, if those fit.
bool last_fits(std::span<const std::uint8_t> record) {
  const std::size_t at = record.size() - 1;
  const std::uint8_t byte = record.back();
  if (at < kValues) {
    return kTimeStamp[at] == '0' ? byte >= '0' && byte <= '9'
                                 : byte == static_cast<std::uint8_t>(kTimeStamp[at]);
  }
  if (at < kEndAt) {
    const bool high = (at - kValues) % 2 == 0;
    return high ? byte <= kHighBits : byte != 0 || record[at - 1] != 0;  // A sensor is never 0.
  }
  return byte == static_cast<std::uint8_t>(kEnd[at - kEndAt]);
}

bool can_begin(std::span<const std::uint8_t> bytes) {
  for (std::size_t length = 1; length <= bytes.size(); ++length) {
    if (!last_fits(bytes.first(length))) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<CyberGloveRecord> CyberGlove3Parser::push(std::uint8_t byte) {
  pending_.push_back(byte);
  if (!last_fits(pending_)) {
    drop_to_next_beginning();
  }
  if (pending_.size() < kRecordLength) {
    return std::nullopt;
  }
  const CyberGloveRecord record = sample();
  pending_.clear();
  in_sync_ = true;
  return record;
}

void CyberGlove3Parser::drop_to_next_beginning() {
  resynchronisations_ += in_sync_ ? 1 : 0;
  in_sync_ = false;
  std::size_t from = 1;
  while (!can_begin(std::span(pending_).subspan(from))) {
    ++from;
  }
  dropped_bytes_ += from;
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(from));
}

CyberGloveRecord CyberGlove3Parser::sample() const {
  CyberGloveRecord record;
  for (std::size_t k = 0; k < record.counts.size(); ++k) {
    const std::size_t at = kValues + 2 * k;
    const int value = pending_[at] << 8 | pending_[at + 1];
    record.counts[k] = static_cast<std::uint16_t>(std::max(value >> 4, 1));
  }
  return record;
}

}  // namespace handway::device
