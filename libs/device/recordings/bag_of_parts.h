#pragma once

#include "recordings/bag_storage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// A file of a bag whose messages are in parts: chunks, and single messages outside of them.
/// @tparam Id number of a connection. @tparam Part has `counts`, its messages by connection.
template <typename Id, typename Part>
class BagOfParts : public BagStorage {
 public:
  [[nodiscard]] std::vector<BagTopic> topics() const final {
    std::map<std::string, BagTopic> by_name;
    for (const auto& [id, topic] : connections()) {
      by_name.emplace(topic.name, topic);
    }
    std::vector<BagTopic> topics;
    topics.reserve(by_name.size());
    for (const auto& [name, topic] : by_name) {
      topics.push_back(topic);
    }
    return topics;
  }

  [[nodiscard]] std::size_t message_count(const std::string& topic) const final {
    const std::set<Id> wanted = connections_of(topic);
    std::uint64_t count = 0;
    for (const Part& part : parts_) {
      for (const auto& [connection, messages] : part.counts) {
        count += wanted.contains(connection) ? messages : 0;
      }
    }
    return static_cast<std::size_t>(count);
  }

  void for_messages(const std::string& topic, std::size_t most, const Take& take) const final {
    const std::set<Id> wanted = connections_of(topic);
    for (const Part& part : parts_) {
      const bool has_messages = std::ranges::any_of(
          part.counts, [&](const auto& count) { return wanted.contains(count.first); });
      if (most == 0 || !has_messages) {
        continue;
      }
      for_messages_of(part, wanted, [&](std::string_view message, double received) {
        if (most > 0) {
          --most;
          take(message, received);
        }
      });
    }
  }

  [[nodiscard]] std::vector<std::string> warnings() const final { return warnings_; }

 protected:
  /// The topic of each connection.
  [[nodiscard]] virtual std::map<Id, BagTopic> connections() const = 0;
  /// Passes the messages of some connections in a part, in the order of their times.
  /// @throws InputError if they are damaged.
  virtual void for_messages_of(const Part& part, const std::set<Id>& connections,
                               const Take& take) const = 0;

  std::vector<Part> parts_;  ///< In the order of the file.
  std::vector<std::string> warnings_;

 private:
  [[nodiscard]] std::set<Id> connections_of(const std::string& topic) const {
    std::set<Id> wanted;
    for (const auto& [id, connection] : connections()) {
      if (connection.name == topic) {
        wanted.insert(id);
      }
    }
    return wanted;
  }
};

}  // namespace handway::device
