#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Files in which ROS stores the messages of a bag.

namespace handway::device {

/// A topic of a bag.
struct BagTopic {
  std::string name;      ///< "/joint_states".
  std::string type;      ///< "sensor_msgs/msg/JointState".
  std::string encoding;  ///< Encoding of its messages: "cdr", "ros1".
};

/// One file of a bag.
class BagStorage {
 public:
  /// Takes a message and the time at which it was received, s since 1970.
  using Take = std::function<void(std::string_view message, double received)>;

  virtual ~BagStorage() = default;

  [[nodiscard]] virtual std::vector<BagTopic> topics() const = 0;
  [[nodiscard]] virtual std::size_t message_count(const std::string& topic) const = 0;
  /// Passes the messages of a topic in the order of their times, `most` of them at most.
  /// @throws InputError if the file is damaged.
  virtual void for_messages(const std::string& topic, std::size_t most, const Take& take) const = 0;
  /// Reasons why a part of the file is not read.
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
};

/// Opens a database of SQLite (.db3). @throws InputError if it is damaged.
[[nodiscard]] std::unique_ptr<BagStorage> open_sqlite_bag(const std::filesystem::path& file);

/// Opens a file of MCAP (.mcap). @throws InputError if it is damaged.
[[nodiscard]] std::unique_ptr<BagStorage> open_mcap_bag(const std::filesystem::path& file);

/// Opens a bag of ROS 1 (.bag). @throws InputError if it is damaged or of an old version.
[[nodiscard]] std::unique_ptr<BagStorage> open_ros1_bag(const std::filesystem::path& file);

/// First bytes of a bag of ROS 1, before its version.
inline constexpr std::string_view kRos1BagMark = "#ROSBAG V";

/// First bytes of a file of MCAP, before its version.
inline constexpr std::string_view kMcapMark = "\x89MCAP";

}  // namespace handway::device
