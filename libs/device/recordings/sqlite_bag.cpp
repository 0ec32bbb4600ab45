#include "handway/geometric/io/input_error.h"
#include "recordings/bag_storage.h"
#include "recordings/sqlite_database.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace handway::device {
namespace {

class SqliteBag final : public BagStorage {
 public:
  explicit SqliteBag(const std::filesystem::path& file) : database_(file) {
    if (!database_.has_table("topics") || !database_.has_table("messages")) {
      throw geometric::InputError({file.string(), "",
                                   "a database without the tables topics and messages",
                                   "a bag of ROS 2", ""});
    }
  }

  [[nodiscard]] std::vector<BagTopic> topics() const override {
    std::vector<BagTopic> topics;
    SqliteDatabase::Rows rows(database_,
                              "SELECT name, type, serialization_format FROM topics ORDER BY name");
    while (rows.next()) {
      topics.push_back(
          {std::string(rows.bytes(0)), std::string(rows.bytes(1)), std::string(rows.bytes(2))});
    }
    return topics;
  }

  [[nodiscard]] std::size_t message_count(const std::string& topic) const override {
    SqliteDatabase::Rows messages(database_,
                                  "SELECT COUNT(*) FROM messages WHERE topic_id IN (SELECT id "
                                  "FROM topics WHERE name = ?1)");
    messages.bind(1, topic);
    return messages.next() ? static_cast<std::size_t>(messages.whole(0)) : 0;
  }

  void for_messages(const std::string& topic, std::size_t most, const Take& take) const override {
    constexpr auto kHighest = static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max());
    SqliteDatabase::Rows messages(database_,
                                  "SELECT timestamp, data FROM messages WHERE topic_id IN "
                                  "(SELECT id FROM topics WHERE name = ?1) ORDER BY timestamp "
                                  "LIMIT ?2");
    messages.bind(1, topic);
    messages.bind(2, static_cast<std::int64_t>(std::min(most, kHighest)));
    while (messages.next()) {
      take(messages.bytes(1), 1e-9 * static_cast<double>(messages.whole(0)));
    }
  }

 private:
  SqliteDatabase database_;
};

}  // namespace

std::unique_ptr<BagStorage> open_sqlite_bag(const std::filesystem::path& file) {
  return std::make_unique<SqliteBag>(file);
}

}  // namespace handway::device
