#include "handway/device/core/line_protocol.h"

#include "handway/geometric/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace handway::device {
namespace {

constexpr std::size_t kLongestQuote = 160;

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

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
  const std::optional<double> value = geometric::parse_number(word);
  if (!value) {
    throw LineProtocolError(fmt::format("{} is no number", quote(word)));
  }
  return *value;
}

std::string quote(std::string_view text) {
  std::string shown(text.substr(0, kLongestQuote));
  std::ranges::replace_if(
      shown, [](char c) { return !is_printable(c); }, '?');
  return fmt::format("\"{}{}\"", shown, text.size() > kLongestQuote ? "..." : "");
}

void LineBuffer::add(std::span<const std::uint8_t> bytes) {
  text_.erase(0, begin_);
  begin_ = 0;
  text_.append(bytes.begin(), bytes.end());
}

std::optional<std::string> LineBuffer::next() {
  const std::size_t end = text_.find('\n', begin_);
  if (std::min(end, text_.size()) - begin_ > longest_) {
    throw LineProtocolError(fmt::format("a line of more than {} characters", longest_));
  }
  if (end == std::string::npos) {
    return std::nullopt;
  }
  std::string line = text_.substr(begin_, end - begin_);
  begin_ = end + 1;
  if (line.ends_with('\r')) {
    line.pop_back();
  }
  return line;
}

}  // namespace handway::device
