#include "glove/text_files.h"

#include <algorithm>
#include <optional>
#include <regex>

namespace handway::device {

std::vector<TextLine> text_lines(std::string_view text) {
  std::vector<TextLine> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    const bool ended = end != std::string_view::npos;
    lines.push_back({text.substr(begin, ended ? end - begin : end), lines.size() + 1, ended});
    begin = ended ? end + 1 : text.size();
  }
  return lines;
}

std::optional<double> parse_cell(std::string_view cell, char separator) {
  const std::size_t comma = cell.find(',');
  if (separator == ',' || comma == std::string_view::npos) {
    return parse_number(cell);
  }
  std::string number(cell);
  number[comma] = '.';  // of a number: a second one is refused
  return parse_number(number);
}

char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';'}) {
    if (line.find(separator) != std::string_view::npos) {
      return separator;
    }
  }
  const auto all_numbers = [&](char separator) {
    const std::vector<std::string_view> parts = cells(line, separator);
    return parts.size() > 1 && std::ranges::all_of(parts, [&](std::string_view part) {
             return parse_cell(part, separator).has_value();
           });
  };
  const bool decimal_commas = !all_numbers(',') && all_numbers(' ');
  return line.find(',') != std::string_view::npos && !decimal_commas ? ',' : ' ';
}

bool has_joint_messages(std::string_view head) {
  if (head.find("position") == std::string_view::npos) {
    return false;  // most files: soon known
  }
  // Landmarks have names and positions, too, but not as lists side by side.
  static const std::regex kNames(R"re((^|\n)name:|"name"\s*:\s*\[)re");
  static const std::regex kPositions(R"re((^|\n)position:|"position"\s*:\s*\[)re");
  const auto has = [&](const std::regex& key) {
    return std::regex_search(head.begin(), head.end(), key);
  };
  return head.find("joint_names") != std::string_view::npos || (has(kNames) && has(kPositions));
}

std::string text_field(const std::string& key, const std::string& text) {
  if (text.empty()) {
    return "";
  }
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return key + ": \"" + quoted + "\"\n";
}

}  // namespace handway::device
