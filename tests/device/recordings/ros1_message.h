#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Messages of ROS 1 for tests.

namespace handway::test {

/// A message in the encoding of ROS 1: little-endian, side by side.
class Ros1Message {
 public:
  template <typename Number>
  void number(Number value) {
    std::string bytes(sizeof(Number), '\0');
    std::memcpy(bytes.data(), &value, sizeof(Number));
    bytes_ += bytes;
  }
  void count(std::size_t value) { number(static_cast<std::uint32_t>(value)); }
  void text(const std::string& word) {
    count(word.size());
    bytes_ += word;
  }
  void texts(const std::vector<std::string>& words) {
    count(words.size());
    for (const std::string& word : words) {
      text(word);
    }
  }
  void numbers(const std::vector<double>& values) {
    count(values.size());
    for (const double value : values) {
      number(value);
    }
  }
  void time(double seconds) {
    number(static_cast<std::uint32_t>(seconds));
    number(static_cast<std::uint32_t>(std::lround(1e9 * (seconds - std::floor(seconds)))));
  }
  /// A header. @param frame whose length moves what follows to odd places.
  void header(double stamp, const std::string& frame = "abc") {
    count(17);  // the sequence
    time(stamp);
    text(frame);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A message of sensor_msgs/JointState.
inline std::string ros1_joint_state(double stamp, const std::vector<std::string>& names,
                                    const std::vector<double>& positions) {
  Ros1Message message;
  message.header(stamp);
  message.texts(names);
  message.numbers(positions);
  message.numbers({});
  message.numbers({});
  return message.bytes();
}

}  // namespace handway::test
