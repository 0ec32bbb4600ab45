#pragma once

#include "handway/geometric/formats/joint_table.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Pieces of text files with numbers.

/// Common parts of this folder's YAML files.

namespace handway::device {

using geometric::cells;
using geometric::has_joint_messages;
using geometric::parse_cell;
using geometric::parse_number;
using geometric::separator_of;
using geometric::text_lines;
using geometric::TextLine;
using geometric::trimmed;

/// "FILE:LINE".
[[nodiscard]] std::string at_line(const std::filesystem::path& file, const TextLine& line);

/// Writes `key: "text"` as a line; nothing for an empty text.
[[nodiscard]] std::string text_field(const std::string& key, const std::string& text);

/// Factor of an angle of VirtualHand that makes flexion positive, and abduction positive when the
/// fingers spread. VirtualHand turns all abductions about the same direction: index and middle
/// finger spread in its negative, ring and little finger in its positive direction.
[[nodiscard]] inline double virtual_hand_sign(int sensor) {
  constexpr std::array kKept{14, 18};  // RingMiddleAbduct, PinkieRingAbduct
  return std::ranges::find(kKept, sensor) == kKept.end() ? -1.0 : 1.0;
}

}  // namespace handway::device
