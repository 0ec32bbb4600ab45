#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/number_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Pieces of text files with numbers.

/// What this folder's YAML files share.

namespace handway::device {

/// A line of a text file without its end.
struct TextLine {
  std::string_view text;
  std::size_t number = 0;  ///< From 1.
  bool ended = true;       ///< False for a last line without its end.
};

/// All lines of a text, of which they stay a part.
[[nodiscard]] std::vector<TextLine> text_lines(std::string_view text);

using geometric::cells;
using geometric::parse_number;
using geometric::trimmed;

/// That of a line's cells: tab, semicolon or comma, the first that it has; a blank if none, or if
/// its commas are decimal ones.
[[nodiscard]] char separator_of(std::string_view line);

/// As parse_number(), with a decimal comma too unless cells are separated by commas.
[[nodiscard]] std::optional<double> parse_cell(std::string_view cell, char separator);

/// Whether a file that begins so has ROS messages of a robot's joints, as YAML or JSON.
[[nodiscard]] bool has_joint_messages(std::string_view head);

/// `key: "text"` as a line; nothing for an empty text.
[[nodiscard]] std::string text_field(const std::string& key, const std::string& text);

/// What to multiply an angle of VirtualHand with to have flexion positive and abduction positive
/// when the fingers spread. VirtualHand turns all abductions about the same direction: index and
/// middle finger spread in its negative, ring and little finger in its positive direction.
[[nodiscard]] inline double virtual_hand_sign(int sensor) {
  constexpr std::array kKept{14, 18};  // RingMiddleAbduct, PinkieRingAbduct
  return std::ranges::find(kKept, sensor) == kKept.end() ? -1.0 : 1.0;
}

}  // namespace handway::device
