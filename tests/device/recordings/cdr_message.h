#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Messages of ROS 2 for tests.

namespace handway::test {

/// A message in little-endian CDR.
class CdrMessage {
 public:
  void text(const std::string& word) {
    number(static_cast<std::uint32_t>(word.size() + 1));
    bytes_ += word + '\0';
  }
  template <typename Number>
  void number(Number value) {
    bytes_.resize((bytes_.size() + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number));
    std::string bytes(sizeof(Number), '\0');
    std::memcpy(bytes.data(), &value, sizeof(Number));
    bytes_ += bytes;
  }
  void stamp(double seconds) {
    number(static_cast<std::int32_t>(seconds));
    number(static_cast<std::uint32_t>(std::lround(1e9 * (seconds - std::floor(seconds)))));
    text("base");
  }
  [[nodiscard]] std::string encapsulated() const { return std::string("\0\x01\0\0", 4) + bytes_; }

 private:
  std::string bytes_;
};

/// A message of sensor_msgs/msg/JointState.
inline std::string joint_state(double stamp, const std::vector<std::string>& names,
                               const std::vector<double>& positions) {
  CdrMessage message;
  message.stamp(stamp);
  message.number(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) {
    message.text(name);
  }
  message.number(static_cast<std::uint32_t>(positions.size()));
  for (const double position : positions) {
    message.number(position);
  }
  message.number(std::uint32_t{0});
  message.number(std::uint32_t{0});
  return message.encapsulated();
}

}  // namespace handway::test
