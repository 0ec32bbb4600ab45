#pragma once

#include <cstdint>
#include <string_view>

/// Files of MCAP. Source: MCAP File Format Specification, version 0.

namespace handway::device {

/// The first and the last bytes of a file.
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

/// Kinds of records.
enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kDataEnd = 0x0F,
};

}  // namespace handway::device
