#include "handway/device/hand/hand_protocol.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace handway::device {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kStateWords = 3;

// Shortest texts that read back to the same bits.
void append(std::string& line, const Eigen::VectorXd& numbers) {
  for (const double number : numbers) {
    line += fmt::format(" {}", number);
  }
}

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
    throw HandProtocolError(fmt::format("\"{}\" is no number", word));
  }
  return value;
}

std::string to_line(const HandState& state) {
  std::string line = fmt::format("state {} {}", state.time, state.phase);
  append(line, state.position);
  return line + "\n";
}

HandState parse_hand_state(std::string_view line, Eigen::Index joints) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != kStateWords + static_cast<std::size_t>(joints) || words[0] != "state") {
    throw HandProtocolError(fmt::format("\"{}\" is no state of {} joints", line, joints));
  }
  HandState state{number_of(words[1]), std::string(words[2]), Eigen::VectorXd(joints)};
  for (Eigen::Index j = 0; j < joints; ++j) {
    state.position[j] = number_of(words[kStateWords + static_cast<std::size_t>(j)]);
  }
  return state;
}

std::string to_lines(const JointTrajectory& trajectory) {
  std::string lines = fmt::format("trajectory {}\n", trajectory.times.size());
  for (std::size_t i = 0; i < trajectory.times.size(); ++i) {
    lines += fmt::format("point {}", trajectory.times[i]);
    append(lines, trajectory.positions.row(static_cast<Eigen::Index>(i)));
    lines += '\n';
  }
  return lines;
}

void HandLines::add(std::span<const std::uint8_t> bytes) {
  text_.append(bytes.begin(), bytes.end());
}

std::optional<std::string> HandLines::next() {
  const std::size_t end = text_.find('\n');
  if (std::min(end, text_.size()) > kLongestLine) {
    throw HandProtocolError("a line without an end");
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
