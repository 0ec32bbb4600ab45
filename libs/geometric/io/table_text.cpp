#include "handway/geometric/io/table_text.h"

#include <algorithm>
#include <cctype>

namespace handway::geometric {

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

std::optional<double> parse_cell(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos) {
    return parse_number(cell);
  }
  std::string number(cell);
  number[comma] = '.';  // of a number: a second one is refused
  return parse_number(number);
}

char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';'}) {
    if (line.find(separator) != std::string_view::npos && cells(line, separator).size() > 1) {
      return separator;
    }
  }
  const auto all_numbers = [&](char separator) {
    const std::vector<std::string_view> parts = cells(line, separator);
    return parts.size() > 1 && std::ranges::all_of(parts, [&](std::string_view part) {
             return parse_cell(part).has_value();
           });
  };
  const bool decimal_commas = !all_numbers(',') && all_numbers(' ');
  return line.find(',') != std::string_view::npos && !decimal_commas ? ',' : ' ';
}

std::vector<std::string> words_of_column(std::string_view name) {
  std::vector<std::string> words(1);
  bool after_small = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter = std::isalnum(byte) != 0 || byte >= 0x80U;
    if ((!is_letter || (after_small && std::isupper(byte) != 0)) && !words.back().empty()) {
      words.emplace_back();
    }
    if (is_letter) {
      words.back() += static_cast<char>(std::tolower(byte));
    }
    after_small = std::islower(byte) != 0;
  }
  std::erase(words, "");
  return words;
}

}  // namespace handway::geometric
