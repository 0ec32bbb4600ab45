#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace handway::device {
namespace {

constexpr std::size_t kLongestLine = 4096;

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    if (end > 0) {
      words.push_back(line.substr(0, end));
    }
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

double number_of(std::string_view word) {
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    throw LineProtocolError(fmt::format("\"{}\" is no number", word));
  }
  return value;
}

void LineBuffer::add(std::span<const std::uint8_t> bytes) {
  text_.append(bytes.begin(), bytes.end());
}

std::optional<std::string> LineBuffer::next() {
  const std::size_t end = text_.find('\n');
  if (std::min(end, text_.size()) > kLongestLine) {
    throw LineProtocolError("a line without an end");
  }
  if (end == std::string::npos) {
    return std::nullopt;
  }
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  if (line.ends_with('\r')) {
    line.pop_back();
  }
  return line;
}

}  // namespace handway::device
