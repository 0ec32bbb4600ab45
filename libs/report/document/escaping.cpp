#include "handway/report/document/escaping.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/printable.h"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>

namespace handway::report {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Returns whether a spreadsheet would take the text for a formula. A number may have a unit.
bool is_formula(const std::string& text) {
  if (text.size() < 2 || geometric::parse_number(text)) {
    return false;
  }
  const bool has_sign = text.front() == '+' || text.front() == '-';
  const bool is_operation = text.find_first_of("+*=|!@(\"'", 1) != std::string::npos;
  return text.front() == '=' || text.front() == '@' || text.front() == '\t' ||
         (has_sign && (is_operation || is_letter(text[1])));
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : geometric::printable(text)) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result.push_back(c);
    }
  }
  return result;
}

std::string markdown_escaped(std::string_view text) {
  const std::string plain = geometric::printable(text);
  std::string result;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      const bool ends_link = c == ']' && plain.substr(i + 1, 1) == "(";
      const bool is_mark = std::string_view("|*`\\").find(c) != std::string_view::npos;
      result += ends_link || is_mark ? "\\" : "";
      result += c == '\n' ? ' ' : c;
    }
  }
  return result;
}

std::string csv_field(const std::string& text) {
  std::string plain = geometric::printable(text);
  if (is_formula(text)) {
    plain.insert(plain.begin(), '\'');
  }
  if (plain.find_first_of(",\"\n\r") == std::string::npos) {
    return plain;
  }
  std::string field = "\"";
  for (const char c : plain) {
    field.append(c == '"' ? 2 : 1, c);
  }
  return field + "\"";
}

std::string link_target(std::string_view file) {
  std::string result;
  for (const char c : file) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                          std::string_view("-_./").find(c) != std::string_view::npos;
    result += is_plain
                  ? std::string(1, c)
                  : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return result;
}

}  // namespace handway::report
