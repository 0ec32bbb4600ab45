#include "handway/geometric/io/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace handway::geometric {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return std::nullopt;
  }
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.front() == '+') {
    text.remove_prefix(1);
    if (text.starts_with('-')) {
      return std::nullopt;
    }
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof(buffer), value == 0.0 ? 0 : value);
  return {buffer, end};
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\n\"";
  const std::size_t first = text.find_first_not_of(kAround);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

namespace {

/// The end of the cell that begins at `begin`: behind its closing quote if it is fully quoted. Two
/// quotes in a row within it are one of its text.
std::size_t end_of_cell(std::string_view line, std::size_t begin, std::string_view separators) {
  const std::size_t first = line.find_first_not_of(" ", begin);
  if (first != std::string_view::npos && line[first] == '"') {
    for (std::size_t quote = line.find('"', first + 1); quote != std::string_view::npos;
         quote = line.find('"', quote + 1)) {
      if (quote + 1 < line.size() && line[quote + 1] == '"') {
        ++quote;
        continue;
      }
      const std::size_t next = line.find_first_not_of(" \r\n", quote + 1);
      const bool is_blank_separated = separators.find(' ') != std::string_view::npos;
      const std::size_t after = is_blank_separated ? quote + 1 : next;
      if (next == std::string_view::npos ||
          separators.find(line[after]) != std::string_view::npos) {
        return std::min(after, line.size());
      }
    }
  }
  return std::min(line.find_first_of(separators, begin), line.size());
}

/// Parts between separators, with the blanks and quotes around them.
std::vector<std::string_view> parts_of(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  const std::string_view separators = separator == ' ' ? kBlanks : std::string_view(&separator, 1);
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = end_of_cell(line, begin, separators);
    if (separator != ' ' || end > begin) {
      parts.push_back(line.substr(begin, end - begin));
    }
    begin = end + 1;
  }
  return parts;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string text_of_cell(std::string_view part) {
  part = without_blanks(part);
  if (part.size() < 2 || part.front() != '"' || part.back() != '"') {
    return std::string(trimmed(part));
  }
  std::string text(without_blanks(part.substr(1, part.size() - 2)));
  for (std::size_t at = text.find("\"\""); at != std::string::npos;
       at = text.find("\"\"", at + 1)) {
    text.erase(at, 1);
  }
  return text;
}

}  // namespace

std::vector<std::string_view> cells(std::string_view line, char separator) {
  std::vector<std::string_view> parts = parts_of(line, separator);
  std::ranges::transform(parts, parts.begin(), trimmed);
  return parts;
}

std::vector<std::string> cell_names(std::string_view line, char separator) {
  std::vector<std::string> names;
  std::ranges::transform(parts_of(line, separator), std::back_inserter(names), text_of_cell);
  return names;
}

}  // namespace handway::geometric
