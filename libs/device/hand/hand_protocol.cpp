#include "handway/device/hand/hand_protocol.h"

#include <fmt/format.h>

namespace handway::device {
namespace {

constexpr std::size_t kStateWords = 3;

// Shortest texts that read back to the same bits.
void append(std::string& line, const Eigen::VectorXd& numbers) {
  for (const double number : numbers) {
    line += fmt::format(" {}", number);
  }
}

}  // namespace

std::string to_line(const HandState& state) {
  std::string line = fmt::format("state {} {}", state.time, state.phase);
  append(line, state.position);
  return line + "\n";
}

HandState parse_hand_state(std::string_view line, Eigen::Index joints) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != kStateWords + static_cast<std::size_t>(joints) || words[0] != "state") {
    throw LineProtocolError(fmt::format("{} is no state of {} joints", quote(line), joints));
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

}  // namespace handway::device
