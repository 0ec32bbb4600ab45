#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "recordings/array_recording.h"
#include "recordings/bag_storage.h"
#include "recordings/message_reader.h"
#include "recordings/recording_formats.h"
#include "recordings/topic_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

/// The files of a bag: the file itself, or those in its folder, which may be several parts.
std::vector<fs::path> files_of(const fs::path& bag) {
  std::error_code error;
  if (!fs::is_directory(bag, error)) {
    return {bag};
  }
  std::vector<fs::path> parts;
  for (const char* ending : {".db3", ".mcap"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(bag, error)) {
      if (geometric::has_extension(entry.path(), ending)) {
        parts.push_back(entry.path());
      }
    }
    if (!parts.empty()) {
      break;
    }
  }
  std::ranges::sort(parts, {}, [](const fs::path& part) {  // x_2.db3 is before x_10.db3
    return std::tuple(part.string().size(), part.string());
  });
  return parts;
}

bool is_mcap(const fs::path& file, std::string_view head) {
  return head.starts_with(kMcapMark) || geometric::has_extension(file, ".mcap");
}

std::unique_ptr<BagStorage> open_storage(const fs::path& file) {
  if (geometric::head_of(file, kRos1BagMark.size()) == kRos1BagMark) {
    return open_ros1_bag(file);
  }
  return is_mcap(file, geometric::head_of(file, kMcapMark.size())) ? open_mcap_bag(file)
                                                                   : open_sqlite_bag(file);
}

/// The encoding of a topic's messages; nothing for one that is not read.
std::optional<MessageEncoding> encoding_of(std::string_view name) {
  return name == "cdr"    ? std::optional(MessageEncoding::kCdr)
         : name == "ros1" ? std::optional(MessageEncoding::kRos1)
                          : std::nullopt;
}

/// The topics of a bag. Messages of a topic are read when they are needed.
class BagTopics final : public ArrayFile {
 public:
  explicit BagTopics(const fs::path& bag) : ArrayFile(bag) {
    for (const fs::path& file : files_of(bag)) {
      parts_.push_back(open_storage(file));
      add_topics(*parts_.back());
    }
    for (RecordingVariable& variable : variables_) {
      try {
        describe(variable);
      } catch (const InputError& error) {
        if (!is_incidental_type(variable.type)) {
          throw;
        }
        variable.problem = fmt::format("messages of {} that can't be read: {}", variable.type,
                                       error.problem().found);
      }
    }
  }

  [[nodiscard]] std::vector<std::string> column_names(
      const RecordingVariable& variable) const override {
    return rows_of(variable).names();
  }

 private:
  static constexpr std::size_t kFirstMessages = 100;

  void add_topics(const BagStorage& part) {
    for (const BagTopic& topic : part.topics()) {
      if (std::ranges::count(variables_, topic.name, &RecordingVariable::name) > 0) {
        continue;
      }
      RecordingVariable variable{topic.name, {}, topic.type, ""};
      const std::optional<MessageEncoding> encoding = encoding_of(topic.encoding);
      if (!encoding) {
        variable.problem = fmt::format("messages encoded as {:.20}", topic.encoding);
      } else if (!rows_of_type(variable.type, variable.name, *encoding)) {
        variable.problem = "messages of " + variable.type;
      } else {
        encodings_[topic.name] = *encoding;
      }
      variables_.push_back(std::move(variable));
    }
  }

  /// Sets the shape: the number of messages, and the size of rows by the first of them. If these
  /// are all, the number is that of the rows: a trajectory has several.
  void describe(RecordingVariable& variable) const {
    std::size_t count = 0;
    for (const auto& part : parts_) {
      count += part->message_count(variable.name);
    }
    variable.shape = {count};
    if (variable.problem.empty()) {
      const auto rows = read_rows(variable, kFirstMessages);
      const std::vector<std::size_t> row = rows->row_shape();
      if (count <= kFirstMessages) {
        variable.shape = {rows->row_count()};
      }
      if (rows->row_count() == 0 && is_incidental_type(variable.type)) {
        variable.problem = "no values in messages of " + variable.type;
        return;
      }
      variable.shape.insert(variable.shape.end(), row.begin(), row.end());
      if (const bool poses = row.size() == 2; poses && !has_landmarks(variable)) {
        variable.problem =
            fmt::format("{} poses, which are not the 21 landmarks of a hand", row[0]);
      }
    }
  }

  [[nodiscard]] std::unique_ptr<TopicRows> read_rows(const RecordingVariable& variable,
                                                     std::size_t most) const {
    std::unique_ptr<TopicRows> rows =
        rows_of_type(variable.type, variable.name, encodings_.at(variable.name));
    std::size_t number = 0;
    const auto add = [&](std::string_view message, double received) {
      ++number;
      try {
        rows->add(message, received);
      } catch (const MessageError& error) {
        throw InputError({path().string(), fmt::format("{}, message {}", variable.name, number),
                          error.what(), "a " + variable.type, ""});
      }
    };
    for (const auto& part : parts_) {
      part->for_messages(variable.name, most - number, add);
    }
    return rows;
  }

  const TopicRows& rows_of(const RecordingVariable& variable) const {
    std::unique_ptr<TopicRows>& rows = rows_[variable.name];
    if (!rows) {
      rows = read_rows(variable, std::numeric_limits<std::size_t>::max());
    }
    return *rows;
  }

  [[nodiscard]] Series read(const RecordingVariable& variable) const override {
    Series series = rows_of(variable).series();
    for (const auto& part : parts_) {
      const std::vector<std::string> warnings = part->warnings();
      series.warnings.insert(series.warnings.end(), warnings.begin(), warnings.end());
    }
    return series;
  }

  std::vector<std::unique_ptr<BagStorage>> parts_;
  std::map<std::string, MessageEncoding> encodings_;  ///< Of topics that are read.
  mutable std::map<std::string, std::unique_ptr<TopicRows>> rows_;
};

class RosBags final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"ROS 2 bag",
            "Topics of a bag of ROS 2 in SQLite (.db3) or MCAP (.mcap), or its folder."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    std::error_code error;
    return file.head().starts_with("SQLite format 3") || is_mcap(file.path(), file.head()) ||
           (fs::is_directory(file.path(), error) &&
            fs::exists(file.path() / "metadata.yaml", error) && !files_of(file.path()).empty());
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<BagTopics>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }
};

class Ros1Bags final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"ROS 1 bag", "Topics of a bag of ROS 1 (.bag, format 2.0)."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return file.head().starts_with(kRos1BagMark);
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<BagTopics>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }
};

}  // namespace

const RecordingFormat& ros1_bag_format() {
  static const Ros1Bags kFormat;
  return kFormat;
}

const RecordingFormat& ros_bag_format() {
  static const RosBags kFormat;
  return kFormat;
}

}  // namespace handway::device
