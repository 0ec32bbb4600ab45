#include "recordings/mcap_records.h"
#include "recordings/table_bytes.h"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Source: MCAP File Format Specification, version 0; OMG, DDS Interoperability Wire Protocol 2.2,
// section 10 (CDR); message definitions of ROS 2's common_interfaces.

namespace handway::device {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are");

constexpr std::size_t kMcapChunkSize = std::size_t{1} << 20;  // bytes of messages, at least

constexpr const char* kHeaderFields =
    "================================================================================\n"
    "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "================================================================================\n"
    "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
constexpr const char* kJointStateFields =
    "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
    "float64[] effort\n";
constexpr const char* kPoseStampedFields = "std_msgs/Header header\ngeometry_msgs/Pose pose\n";
constexpr const char* kPoseFields =
    "================================================================================\n"
    "MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\n"
    "geometry_msgs/Quaternion orientation\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";

template <typename Number>
void append_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Number));
}

void append_field(std::string& bytes, std::string_view text) {
  append_number(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

std::string mcap_record(McapOpcode opcode, std::string_view content) {
  std::string bytes;
  append_number(bytes, opcode);
  append_number(bytes, static_cast<std::uint64_t>(content.size()));
  bytes += content;
  return bytes;
}

/// A message in CDR, little endian.
class CdrWriter {
 public:
  template <typename Number>
  void number(Number value) {
    while ((bytes_.size() - kEncapsulation) % sizeof(Number) != 0) {
      bytes_ += '\0';
    }
    append_number(bytes_, value);
  }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes_ += text;
    bytes_ += '\0';
  }
  /// Adds a std_msgs/Header in the frame of the world. @param time ns.
  void header(std::uint64_t time) {
    constexpr std::uint64_t kSecond = 1'000'000'000;
    number(static_cast<std::int32_t>(time / kSecond));
    number(static_cast<std::uint32_t>(time % kSecond));
    text("world");
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kEncapsulation = 4;

  std::string bytes_ = {'\0', '\1', '\0', '\0'};
};

/// A topic, and the columns of the table that its messages have.
struct BagTopicColumns {
  std::string name;
  bool is_pose = false;
  std::vector<Eigen::Index> columns;
  bool is_raw = false;  ///< The columns are those of the source.
};

// Returns the name of a pose whose seven columns begin at `first`: "palm" for "palm.x", "palm.y",
// ….
std::optional<std::string> pose_at(const std::vector<std::string>& names, std::size_t first) {
  static constexpr std::array kParts{".x", ".y", ".z", ".qx", ".qy", ".qz", ".qw"};
  if (first + kParts.size() > names.size() || !names[first].ends_with(kParts.front())) {
    return std::nullopt;
  }
  const std::string name = names[first].substr(0, names[first].size() - 2);
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    if (names[first + i] != name + kParts[i]) {
      return std::nullopt;
    }
  }
  return name;
}

// Names of topics have letters, digits and underscores.
std::string topic_name(const std::string& name) {
  std::string topic = name;
  std::ranges::replace_if(
      topic, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return "/" + topic;
}

// Returns the topics of a table: first the columns that are no poses, as joints.
std::vector<BagTopicColumns> topics_of(const std::vector<std::string>& names) {
  std::vector<BagTopicColumns> topics{{"/joint_states", false, {}, false}};
  for (std::size_t i = 0; i < names.size();) {
    const std::optional<std::string> pose = pose_at(names, i);
    const std::size_t end = i + (pose ? 7 : 1);
    if (pose) {
      topics.push_back({topic_name(*pose), true, {}, false});
    }
    BagTopicColumns& topic = pose ? topics.back() : topics.front();
    for (; i < end; ++i) {
      topic.columns.push_back(static_cast<Eigen::Index>(i));
    }
  }
  if (topics.front().columns.empty()) {
    topics.erase(topics.begin());
  }
  return topics;
}

/// @param labels names of the columns. @param values those of a row.
std::string message_of(const std::vector<std::string>& labels, const Eigen::RowVectorXd& values,
                       const BagTopicColumns& topic, std::uint64_t time) {
  CdrWriter message;
  message.header(time);
  if (!topic.is_pose) {
    const auto count = static_cast<std::uint32_t>(topic.columns.size());
    message.number(count);
    for (const Eigen::Index column : topic.columns) {
      message.text(labels[static_cast<std::size_t>(column)]);
    }
    message.number(count);
  }
  for (const Eigen::Index column : topic.columns) {
    message.number(values[column]);
  }
  if (!topic.is_pose) {
    message.number(std::uint32_t{0});  // no velocities
    message.number(std::uint32_t{0});  // no efforts
  }
  return message.bytes();
}

// Schemas and channels of the topics; the id of both is the number of the topic, from 1.
std::string definitions(const std::vector<BagTopicColumns>& topics) {
  std::string bytes;
  std::uint16_t id = 0;
  for (const BagTopicColumns& topic : topics) {
    ++id;
    std::string schema;
    append_number(schema, id);
    append_field(schema,
                 topic.is_pose ? "geometry_msgs/msg/PoseStamped" : "sensor_msgs/msg/JointState");
    append_field(schema, "ros2msg");
    append_field(schema, topic.is_pose
                             ? std::string(kPoseStampedFields) + kHeaderFields + kPoseFields
                             : std::string(kJointStateFields) + kHeaderFields);
    bytes += mcap_record(McapOpcode::kSchema, schema);
    std::string channel;
    append_number(channel, id);
    append_number(channel, id);
    append_field(channel, topic.name);
    append_field(channel, "cdr");
    append_field(channel, "");  // no metadata
    bytes += mcap_record(McapOpcode::kChannel, channel);
  }
  return bytes;
}

/// Writes a bag in chunks, with an index.
class McapWriter {
 public:
  explicit McapWriter(const std::vector<BagTopicColumns>& topics)
      : definitions_(definitions(topics)) {
    std::string header;
    append_field(header, "ros2");
    append_field(header, "handway");
    bytes_ = std::string(kMcapMagic) + mcap_record(McapOpcode::kHeader, header);
    records_ = definitions_;
  }

  /// Adds a message. @param channel its id, from 1. @param time ns, never less than before.
  void add(std::uint16_t channel, std::uint64_t time, std::string_view data) {
    first_ = count_ == 0 ? time : first_;
    chunk_first_ = places_.empty() ? time : chunk_first_;
    last_ = time;
    places_[channel].emplace_back(time, records_.size());
    std::string message;
    append_number(message, channel);
    append_number(message, static_cast<std::uint32_t>(counts_[channel]++));
    append_number(message, time);
    append_number(message, time);  // published when it was logged
    message += data;
    records_ += mcap_record(McapOpcode::kMessage, message);
    ++count_;
    if (records_.size() >= kMcapChunkSize) {
      end_chunk();
    }
  }

  [[nodiscard]] std::string finish() {
    if (!places_.empty()) {
      end_chunk();
    }
    std::string data_end;
    append_number(data_end, std::uint32_t{0});  // no checksum
    bytes_ += mcap_record(McapOpcode::kDataEnd, data_end);
    const std::uint64_t summary = bytes_.size();
    bytes_ += definitions_;
    bytes_ += mcap_record(McapOpcode::kStatistics, statistics());
    bytes_ += chunk_indexes_;
    std::string footer;
    append_number(footer, summary);
    append_number(footer, std::uint64_t{0});  // no offsets of its parts
    append_number(footer, std::uint32_t{0});  // no checksum
    bytes_ += mcap_record(McapOpcode::kFooter, footer);
    bytes_ += kMcapMagic;
    return std::move(bytes_);
  }

 private:
  void end_chunk() {
    boost::crc_32_type checksum;
    checksum.process_bytes(records_.data(), records_.size());
    std::string chunk;
    append_number(chunk, chunk_first_);
    append_number(chunk, last_);
    append_number(chunk, static_cast<std::uint64_t>(records_.size()));
    append_number(chunk, static_cast<std::uint32_t>(checksum.checksum()));
    append_field(chunk, "");  // not compressed
    append_number(chunk, static_cast<std::uint64_t>(records_.size()));
    chunk += records_;
    const std::uint64_t begin = bytes_.size();
    bytes_ += mcap_record(McapOpcode::kChunk, chunk);
    const std::uint64_t end = bytes_.size();
    std::string offsets;
    for (const auto& [channel, places] : places_) {
      append_number(offsets, channel);
      append_number(offsets, static_cast<std::uint64_t>(bytes_.size()));
      add_message_index(channel, places);
    }
    std::string index;
    append_number(index, chunk_first_);
    append_number(index, last_);
    append_number(index, begin);
    append_number(index, end - begin);
    append_field(index, offsets);
    append_number(index, static_cast<std::uint64_t>(bytes_.size() - end));
    append_field(index, "");
    append_number(index, static_cast<std::uint64_t>(records_.size()));
    append_number(index, static_cast<std::uint64_t>(records_.size()));
    chunk_indexes_ += mcap_record(McapOpcode::kChunkIndex, index);
    ++chunks_;
    records_.clear();
    places_.clear();
  }

  void add_message_index(std::uint16_t channel,
                         const std::vector<std::pair<std::uint64_t, std::uint64_t>>& places) {
    std::string entries;
    for (const auto& [time, offset] : places) {
      append_number(entries, time);
      append_number(entries, offset);
    }
    std::string index;
    append_number(index, channel);
    append_field(index, entries);
    bytes_ += mcap_record(McapOpcode::kMessageIndex, index);
  }

  [[nodiscard]] std::string statistics() const {
    std::string counts;
    for (const auto& [channel, count] : counts_) {
      append_number(counts, channel);
      append_number(counts, count);
    }
    const auto channels = static_cast<std::uint32_t>(counts_.size());
    std::string statistics;
    append_number(statistics, count_);
    append_number(statistics, static_cast<std::uint16_t>(channels));
    append_number(statistics, channels);
    append_number(statistics, std::uint32_t{0});  // attachments
    append_number(statistics, std::uint32_t{0});  // metadata
    append_number(statistics, chunks_);
    append_number(statistics, first_);
    append_number(statistics, last_);
    append_field(statistics, counts);
    return statistics;
  }

  std::string definitions_;
  std::string bytes_;
  std::string records_;  ///< Records of the chunk that is written.
  std::string chunk_indexes_;
  /// Time and place of the chunk's messages, by channel.
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  std::uint32_t chunks_ = 0;
  std::uint64_t first_ = 0;
  std::uint64_t chunk_first_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace

std::string mcap_bytes(const RecordedTable& table) {
  constexpr double kLastSecond = 2147483647.0;  // of a stamp
  std::vector<BagTopicColumns> topics = topics_of(table.names);
  const std::vector<std::string> raw_labels =
      table.raw ? labels_of(*table.raw) : std::vector<std::string>{};
  if (table.raw) {
    BagTopicColumns& raw = topics.emplace_back();
    raw.name = "/raw";
    raw.is_raw = true;
    raw.columns.resize(raw_labels.size());
    std::iota(raw.columns.begin(), raw.columns.end(), Eigen::Index{0});
  }
  McapWriter bag(topics);
  const Eigen::Index rows = table.values.rows();
  const bool fits = rows == 0 || (table.times[0] >= 0.0 && table.times[rows - 1] < kLastSecond);
  const double origin = fits ? 0.0 : table.times[0];
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto time = static_cast<std::uint64_t>(std::llround(1e9 * (table.times[row] - origin)));
    std::uint16_t channel = 0;
    for (const BagTopicColumns& topic : topics) {
      bag.add(++channel, time,
              topic.is_raw ? message_of(raw_labels, table.raw->values.row(row), topic, time)
                           : message_of(table.names, table.values.row(row), topic, time));
    }
  }
  return bag.finish();
}

}  // namespace handway::device
