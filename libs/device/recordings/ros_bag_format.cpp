#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/array_recording.h"
#include "recordings/cdr_reader.h"
#include "recordings/recording_formats.h"
#include "recordings/sqlite_database.h"
#include "recordings/topic_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

/// The databases of a bag: the file itself, or those in its folder, which may be several parts.
std::vector<fs::path> databases_of(const fs::path& bag) {
  std::error_code error;
  if (!fs::is_directory(bag, error)) {
    return {bag};
  }
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(bag, error)) {
    if (geometric::has_extension(entry.path(), ".db3")) {
      parts.push_back(entry.path());
    }
  }
  std::ranges::sort(parts, {}, [](const fs::path& part) {  // x_2.db3 is before x_10.db3
    return std::tuple(part.string().size(), part.string());
  });
  return parts;
}

/// The topics of a bag of ROS 2 in SQLite. Messages of a topic are read when they are needed.
class BagTopics final : public ArrayFile {
 public:
  explicit BagTopics(const fs::path& bag) : ArrayFile(bag) {
    for (const fs::path& file : databases_of(bag)) {
      databases_.push_back(std::make_unique<SqliteDatabase>(file));
      if (!databases_.back()->has_table("topics") || !databases_.back()->has_table("messages")) {
        throw InputError({file.string(), "", "a database without the tables topics and messages",
                          "a bag of ROS 2", ""});
      }
      add_topics(*databases_.back());
    }
    for (RecordingVariable& variable : variables_) {
      describe(variable);
    }
  }

  [[nodiscard]] std::vector<std::string> column_names(
      const RecordingVariable& variable) const override {
    return rows_of(variable).names();
  }

 private:
  static constexpr std::int64_t kFirstMessages = 100;

  void add_topics(const SqliteDatabase& database) {
    SqliteDatabase::Rows topics(
        database, "SELECT name, type, serialization_format FROM topics ORDER BY name");
    while (topics.next()) {
      const std::string name(topics.bytes(0));
      if (std::ranges::count(variables_, name, &RecordingVariable::name) > 0) {
        continue;
      }
      RecordingVariable variable{name, {}, std::string(topics.bytes(1)), ""};
      if (topics.bytes(2) != "cdr") {
        variable.problem = fmt::format("messages encoded as {:.20}", topics.bytes(2));
      } else if (!rows_of_type(variable.type)) {
        variable.problem = "messages of " + variable.type;
      }
      variables_.push_back(std::move(variable));
    }
  }

  /// Sets the shape: the number of messages, and the size of rows by the first of them. If these
  /// are all, the number is that of the rows: a trajectory has several.
  void describe(RecordingVariable& variable) const {
    std::size_t count = 0;
    for (const auto& database : databases_) {
      SqliteDatabase::Rows messages(*database,
                                    "SELECT COUNT(*) FROM messages WHERE topic_id IN (SELECT id "
                                    "FROM topics WHERE name = ?1)");
      messages.bind(1, variable.name);
      count += messages.next() ? static_cast<std::size_t>(messages.whole(0)) : 0;
    }
    variable.shape = {count};
    if (variable.problem.empty()) {
      const auto rows = read_rows(variable, kFirstMessages);
      const std::vector<std::size_t> row = rows->row_shape();
      if (count <= static_cast<std::size_t>(kFirstMessages)) {
        variable.shape = {rows->row_count()};
      }
      variable.shape.insert(variable.shape.end(), row.begin(), row.end());
      if (const bool poses = row.size() == 2; poses && !has_landmarks(variable)) {
        variable.problem =
            fmt::format("{} poses, which are not the 21 landmarks of a hand", row[0]);
      }
    }
  }

  [[nodiscard]] std::unique_ptr<TopicRows> read_rows(const RecordingVariable& variable,
                                                     std::int64_t most) const {
    std::unique_ptr<TopicRows> rows = rows_of_type(variable.type);
    std::int64_t number = 0;
    for (const auto& database : databases_) {
      SqliteDatabase::Rows messages(
          *database,
          "SELECT timestamp, data FROM messages WHERE topic_id IN "
          "(SELECT id FROM topics WHERE name = ?1) ORDER BY timestamp LIMIT ?2");
      messages.bind(1, variable.name);
      messages.bind(2, most - number);
      while (number < most && messages.next()) {
        ++number;
        try {
          rows->add(messages.bytes(1), 1e-9 * static_cast<double>(messages.whole(0)));
        } catch (const CdrError& error) {
          throw InputError({path().string(), fmt::format("{}, message {}", variable.name, number),
                            error.what(), "a " + variable.type, ""});
        }
      }
    }
    return rows;
  }

  const TopicRows& rows_of(const RecordingVariable& variable) const {
    std::unique_ptr<TopicRows>& rows = rows_[variable.name];
    if (!rows) {
      rows = read_rows(variable, std::numeric_limits<std::int64_t>::max());
    }
    return *rows;
  }

  [[nodiscard]] Series read(const RecordingVariable& variable) const override {
    return rows_of(variable).series();
  }

  std::vector<std::unique_ptr<SqliteDatabase>> databases_;
  mutable std::map<std::string, std::unique_ptr<TopicRows>> rows_;
};

class RosBags final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"ROS 2 bag", "Topics of a bag of ROS 2 in SQLite (.db3), or its folder."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    std::error_code error;
    return file.head().starts_with("SQLite format 3") ||
           (fs::is_directory(file.path(), error) &&
            fs::exists(file.path() / "metadata.yaml", error) && !databases_of(file.path()).empty());
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<BagTopics>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }
};

}  // namespace

const RecordingFormat& ros_bag_format() {
  static const RosBags kFormat;
  return kFormat;
}

}  // namespace handway::device
