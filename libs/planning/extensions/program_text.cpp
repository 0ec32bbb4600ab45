#include "handway/planning/extensions/program_text.h"

#include "handway/geometric/io/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace handway::planning {
namespace {

// FNV-1a, 32 bits.
std::uint32_t hash_of(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  }
  return hash;
}

}  // namespace

std::string fixed_decimals(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string duration_decimals(double seconds, int decimals) {
  constexpr double kRounding = 1e-3;  // of the last decimal
  const double unit = std::pow(10.0, decimals);
  return fixed_decimals(std::ceil(seconds * unit - kRounding) / unit, decimals);
}

std::string printable_line(std::string_view text, std::size_t longest) {
  std::string line(text.substr(0, longest));
  std::ranges::replace_if(
      line, [](char c) { return c < ' ' || c > '~' || c == '"' || c == '\\'; }, '?');
  return line;
}

std::string program_name(const std::string& name, std::size_t longest,
                         std::span<const std::string_view> keywords) {
  std::string result = std::ranges::find(keywords, geometric::lower_case(name)) != keywords.end()
                           ? "hw_" + name
                           : name;
  if (result.size() > longest) {
    constexpr std::size_t kEnd = 5;
    result = fmt::format("{}_{:04x}", result.substr(0, longest - kEnd), hash_of(name) & 0xffffU);
  }
  return result;
}

}  // namespace handway::planning
