#include "handway/device/haptic/haptic_protocol.h"

#include <fmt/format.h>

namespace handway::device {
namespace {

using Words = std::vector<std::string_view>;

Words words_after(std::string_view word, std::size_t count, std::string_view line) {
  Words words = words_of(line);
  if (words.size() != count + 1 || words.front() != word) {
    throw LineProtocolError(fmt::format("{} is no \"{}\" with {} words", quote(line), word, count));
  }
  words.erase(words.begin());
  return words;
}

Eigen::Vector3d vector_at(const Words& words, std::size_t first) {
  return {number_of(words[first]), number_of(words[first + 1]), number_of(words[first + 2])};
}

}  // namespace

std::string hello_line(const HapticAbilities& abilities) {
  const Eigen::Vector3d& half = abilities.workspace;
  return fmt::format("hello {} {} {} {} {}\n", kHapticProtocolVersion, abilities.force, half.x(),
                     half.y(), half.z());
}

std::string state_line(const HapticSample& sample) {
  const Eigen::Vector3d& p = sample.position;
  const Eigen::Vector3d& v = sample.velocity;
  return fmt::format("state {} {} {} {} {} {} {} {}\n", sample.time, p.x(), p.y(), p.z(), v.x(),
                     v.y(), v.z(), sample.button ? 1 : 0);
}

std::string force_line(const Eigen::Vector3d& force) {
  return fmt::format("force {} {} {}\n", force.x(), force.y(), force.z());
}

HapticAbilities parse_haptic_hello(std::string_view line) {
  const Words words = words_after("hello", 5, line);
  if (number_of(words[0]) != kHapticProtocolVersion) {
    throw LineProtocolError(fmt::format("version {} of the protocol", quote(words[0])));
  }
  const HapticAbilities abilities{number_of(words[1]), vector_at(words, 2)};
  if (!(abilities.force > 0.0) || !(abilities.workspace.array() > 0.0).all()) {
    throw LineProtocolError(fmt::format("{}: a device without force or workspace", quote(line)));
  }
  return abilities;
}

HapticSample parse_haptic_state(std::string_view line) {
  const Words words = words_after("state", 8, line);
  if (words[7] != "0" && words[7] != "1") {
    throw LineProtocolError(fmt::format("a button at {}", quote(words[7])));
  }
  return {number_of(words[0]), vector_at(words, 1), vector_at(words, 4), words[7] == "1"};
}

Eigen::Vector3d parse_haptic_force(std::string_view line) {
  return vector_at(words_after("force", 3, line), 0);
}

}  // namespace handway::device
