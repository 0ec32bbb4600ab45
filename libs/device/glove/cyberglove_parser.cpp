#include "handway/device/glove/cyberglove_parser.h"

#include "handway/device/glove/glove_layout.h"

namespace handway::device {

namespace {

constexpr std::uint8_t kControlC = 0x03;

std::optional<CyberGloveRecordKind> error_kind(std::uint8_t letter) {
  switch (letter) {
    case 'g':
      return CyberGloveRecordKind::kUnplugged;
    case 's':
      return CyberGloveRecordKind::kTooFast;
    case 'y':
      return CyberGloveRecordKind::kSyncRate;
    case '?':
      return CyberGloveRecordKind::kUnknownCommand;
    default:
      return std::nullopt;
  }
}

}  // namespace

CyberGloveParser::CyberGloveParser(const CyberGloveFormat& format) : format_(format) {
  (void)cyberglove_wired(format.sensors);  // Refuses other numbers of sensors.
  pending_.reserve(format.record_length());
}

std::optional<CyberGloveRecord> CyberGloveParser::push(std::uint8_t byte) {
  if (byte != 0) {
    ++pending_length_;
    if (pending_.size() < format_.record_length()) {
      pending_.push_back(byte);
    }
    return std::nullopt;
  }
  const std::optional<CyberGloveRecord> record = classify();
  if (record) {
    in_sync_ = true;
  } else {
    dropped_bytes_ += pending_length_ + 1;
    resynchronisations_ += in_sync_ ? 1 : 0;
    in_sync_ = false;
  }
  reset();
  return record;
}

void CyberGloveParser::reset() {
  pending_.clear();
  pending_length_ = 0;
}

std::optional<CyberGloveRecord> CyberGloveParser::classify() const {
  if (pending_.size() == 1 && pending_[0] == kControlC) {
    return CyberGloveRecord{.kind = CyberGloveRecordKind::kStopped};
  }
  if (pending_.empty() || (pending_[0] != 'G' && pending_[0] != 'S')) {
    return std::nullopt;
  }
  if (pending_.size() + 1 == format_.record_length()) {
    return sample();
  }
  if (pending_.size() == 3 && pending_[1] == 'e') {
    if (const auto kind = error_kind(pending_[2])) {
      return CyberGloveRecord{.kind = *kind};
    }
  }
  return std::nullopt;
}

CyberGloveRecord CyberGloveParser::sample() const {
  CyberGloveRecord record;
  std::size_t at = 1;
  for (const int sensor : cyberglove_wired(format_.sensors)) {
    record.counts[static_cast<std::size_t>(sensor)] = pending_[at++];
  }
  if (format_.time_stamp) {
    // A zero byte is sent as another one, which a bit of the first byte marks.
    const std::uint8_t zeros = pending_[at++];
    for (unsigned k = 0; k < 4; ++k) {
      const std::uint8_t byte = (zeros >> k & 1U) != 0 ? 0 : pending_[at];
      record.time_stamp = record.time_stamp << 8U | byte;
      ++at;
    }
  }
  if (format_.status) {
    record.status = pending_[at];
  }
  return record;
}

}  // namespace handway::device
