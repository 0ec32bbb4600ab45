#include "handway/geometric/io/table_text.h"

#include "handway/geometric/io/lower_case.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

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

namespace {

// Returns whether a line has a character outside of quotes; of quotes without an end, anywhere.
bool has_outside_quotes(std::string_view line, char wanted) {
  const bool has_pairs = std::ranges::count(line, '"') % 2 == 0;
  bool is_quoted = false;
  return std::ranges::any_of(line, [&](char c) {
    is_quoted ^= has_pairs && c == '"';
    return c == wanted && !is_quoted;
  });
}

}  // namespace

char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';'}) {
    if (has_outside_quotes(line, separator) && cells(line, separator).size() > 1) {
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

std::string unit_in_brackets(std::string_view name) {
  const std::size_t begin = name.find_last_of("[(");
  if (name.empty() || (name.back() != ']' && name.back() != ')') ||
      begin == std::string_view::npos) {
    return "";
  }
  return lower_case(std::string(trimmed(name.substr(begin + 1, name.size() - begin - 2))));
}

std::string csv_cell(const std::string& name) {
  const bool is_formula = name.find_first_of("=+-@") == 0;
  if (!is_formula && name.find_first_of(",;\t\n\r\"") == std::string::npos) {
    return name;
  }
  std::string cell = "\"";
  for (const char c : name) {
    cell += c == '\n' || c == '\r' ? ' ' : c;
    if (c == '"') {
      cell += c;
    }
  }
  return cell + '"';
}

bool append_units(std::vector<std::string>& names, const std::vector<std::string_view>& row) {
  constexpr std::array<std::string_view, 38> kUnits = {
      "s",      "sec",       "ms",     "us",   "\u00B5s",  "\u03BCs",     "ns",
      "min",    "h",         "rad",    "rads", "mrad",     "deg",         "degs",
      "degree", "degrees",   "\u00B0", "m",    "mm",       "cm",          "rad/s",
      "deg/s",  "\u00B0/s",  "m/s",    "mm/s", "rad/s^2",  "rad/s\u00B2", "deg/s^2",
      "m/s^2",  "m/s\u00B2", "n",      "nm",   "n\u00B7m", "v",           "a",
      "ma",     "hz",        "%"};
  if (names.size() != row.size()) {
    return false;
  }
  std::vector<std::string> with_units = names;
  bool has_unit = false;
  for (std::size_t c = 0; c < row.size(); ++c) {
    std::string_view cell = trimmed(row[c]);
    if (cell.size() > 2 && (cell.front() == '[' || cell.front() == '(')) {
      cell = trimmed(cell.substr(1, cell.size() - 2));
    }
    if (cell.empty() || cell == "-") {
      continue;
    }
    const std::string unit = lower_case(std::string(cell));
    if (std::ranges::find(kUnits, unit) == kUnits.end()) {
      return false;
    }
    has_unit = true;
    with_units[c] += " [" + unit + "]";
  }
  if (has_unit) {
    names = std::move(with_units);
  }
  return has_unit;
}

}  // namespace handway::geometric
