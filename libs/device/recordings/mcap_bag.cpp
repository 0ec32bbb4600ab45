#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/printable.h"
#include "recordings/bag_of_parts.h"
#include "recordings/decompression.h"
#include "recordings/file_bytes.h"
#include "recordings/mcap_records.h"
#include "recordings/record_fields.h"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

// Source: MCAP File Format Specification, version 0.

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr const char* kWhatMcap = "a bag of ROS 2 in MCAP";
constexpr std::uint64_t kRecordHead = 9;                           // bytes: the kind and the size
constexpr std::uint64_t kLargestRecord = std::uint64_t{64} << 20;  // bytes, but of chunks
constexpr std::uint64_t kLargestMcapChunk = std::uint64_t{256} << 20;  // bytes, in memory

/// A record in the file, without its content.
struct RecordPlace {
  McapOpcode opcode{};
  std::uint64_t offset = 0;  ///< Place of its content in the file.
  std::uint64_t size = 0;    ///< Size of its content, bytes.
};

/// Records of messages: a chunk, or a single message outside of chunks.
struct MessagePart {
  RecordPlace place;
  std::map<std::uint16_t, std::uint64_t> counts;  ///< Messages by channel.
  bool is_indexed = false;                        ///< The counts are known.
};

struct Channel {
  std::uint16_t schema = 0;
  BagTopic topic;
};

/// A message in a chunk.
struct TimedMessage {
  std::uint64_t received = 0;  ///< ns
  std::string_view data;
};

class McapBag final : public BagOfParts<std::uint16_t, MessagePart> {
 public:
  explicit McapBag(const fs::path& file) : bytes_(file, kWhatMcap) {
    const std::string magic = bytes_.read(0, kMcapMagic.size());
    if (!magic.starts_with(kMcapMark)) {
      throw InputError(
          {file.string(), "", "a file without the mark of MCAP at its beginning", kWhatMcap, ""});
    }
    if (magic != kMcapMagic) {
      throw InputError({file.string(), "", "another version of MCAP, or a damaged beginning",
                        "MCAP of version 0", ""});
    }
    find_records();
    for (MessagePart& part : parts_) {
      if (!is_known(part)) {
        look_into(part);
      }
    }
    for (auto& [id, channel] : channels_) {
      const auto schema = schemas_.find(channel.schema);
      channel.topic.type = schema == schemas_.end() ? "" : schema->second;
    }
  }

 protected:
  [[nodiscard]] std::map<std::uint16_t, BagTopic> connections() const override {
    std::map<std::uint16_t, BagTopic> topics;
    for (const auto& [id, channel] : channels_) {
      topics.emplace(id, channel.topic);
    }
    return topics;
  }

  void for_messages_of(const MessagePart& part, const std::set<std::uint16_t>& channels,
                       const Take& take) const override {
    const std::string records = records_of(part.place);
    for (const TimedMessage& message : messages_in(part.place, records, channels)) {
      take(message.data, 1e-9 * static_cast<double>(message.received));
    }
  }

 private:
  /// Calls `read`, and names the file and the record in its errors.
  template <typename Read>
  auto at_record(const RecordPlace& place, const Read& read) const {
    try {
      return read();
    } catch (const RecordError& error) {
      throw InputError({bytes_.path().string(), fmt::format("record at byte {}", place.offset),
                        error.what(), kWhatMcap, "Copy the file again, or run mcap recover."});
    }
  }

  /// Finds all records in the file without reading messages.
  void find_records() {
    std::uint64_t offset = kMcapMagic.size();
    bool has_footer = false;
    while (!has_footer && bytes_.has(offset, kRecordHead)) {
      FieldReader head(head_at(offset));
      RecordPlace place{static_cast<McapOpcode>(head.number<std::uint8_t>()), offset + kRecordHead,
                        0};
      place.size = head.number<std::uint64_t>();
      if (!bytes_.has(place.offset, place.size)) {
        break;
      }
      at_record(place, [&] { note_record(place, head.rest()); });
      has_footer = place.opcode == McapOpcode::kFooter;
      offset = place.offset + place.size;
    }
    if (!has_footer) {
      warnings_.push_back(fmt::format("{}: the file is cut off: {} bytes at its end are left out",
                                      bytes_.path().string(),
                                      bytes_.size() - std::min(offset, bytes_.size())));
    }
  }

  /// The beginning of the record at that place, which is enough for all but schemas and channels.
  [[nodiscard]] std::string_view head_at(std::uint64_t offset) {
    constexpr std::uint64_t kBeginning = 128;
    head_ = bytes_.read(offset, kBeginning);
    return head_;
  }

  /// @param beginning the first bytes behind the record's size.
  void note_record(const RecordPlace& place, std::string_view beginning) {
    FieldReader fields(beginning.substr(
        0, static_cast<std::size_t>(std::min<std::uint64_t>(place.size, beginning.size()))));
    switch (place.opcode) {
      case McapOpcode::kSchema:
      case McapOpcode::kChannel:
        note_definition(place.opcode, FieldReader(read_record(place)));
        break;
      case McapOpcode::kMessage:
        parts_.push_back({place, {{fields.number<std::uint16_t>(), 1}}, true});
        break;
      case McapOpcode::kChunk:
        parts_.push_back({place, {}, false});
        break;
      case McapOpcode::kMessageIndex:
        note_index(fields);
        break;
      default:
        break;
    }
  }

  /// Reads the record behind a chunk that names the messages of a channel in it.
  void note_index(FieldReader& fields) {
    constexpr std::uint64_t kEntry = 16;  // bytes: time and place of a message
    if (parts_.empty() || parts_.back().place.opcode != McapOpcode::kChunk) {
      return;
    }
    const auto channel = fields.number<std::uint16_t>();
    if (const std::uint64_t count = fields.number<std::uint32_t>() / kEntry; count > 0) {
      parts_.back().counts[channel] += count;
    }
    parts_.back().is_indexed = true;
  }

  /// Reads a schema or a channel.
  void note_definition(McapOpcode opcode, FieldReader fields) {
    const auto id = fields.number<std::uint16_t>();
    if (opcode == McapOpcode::kSchema) {
      schemas_.emplace(id, geometric::printable(fields.text()));
      return;
    }
    Channel channel;
    channel.schema = fields.number<std::uint16_t>();
    channel.topic.name = geometric::printable(fields.text());
    channel.topic.encoding = geometric::printable(fields.text());
    channels_.emplace(id, std::move(channel));
  }

  /// Returns whether the contents of a part are known without decompressing it.
  [[nodiscard]] bool is_known(const MessagePart& part) const {
    return part.is_indexed && std::ranges::all_of(part.counts, [this](const auto& count) {
             const auto channel = channels_.find(count.first);
             return channel != channels_.end() &&
                    (channel->second.schema == 0 || schemas_.contains(channel->second.schema));
           });
  }

  /// Finds schemas, channels and messages in a chunk.
  void look_into(MessagePart& part) {
    if (part.place.opcode != McapOpcode::kChunk) {
      return;
    }
    part.counts.clear();
    const std::string records = records_of(part.place);
    for_records(part.place, records, [&](McapOpcode opcode, FieldReader fields) {
      if (opcode == McapOpcode::kSchema || opcode == McapOpcode::kChannel) {
        note_definition(opcode, fields);
      } else if (opcode == McapOpcode::kMessage) {
        ++part.counts[fields.number<std::uint16_t>()];
      }
    });
  }

  /// The content of a record. @throws RecordError if it is too large.
  const std::string& read_record(const RecordPlace& place) {
    if (place.size > kLargestRecord) {
      throw RecordError(
          fmt::format("a record of {} bytes, which are more than can be read", place.size));
    }
    record_ = bytes_.read(place.offset, place.size);
    return record_;
  }

  /// The records in a part, decompressed; of a message the record itself with its head.
  [[nodiscard]] std::string records_of(const RecordPlace& place) const {
    return at_record(place, [&] {
      if (place.size > kLargestMcapChunk) {
        throw RecordError(
            fmt::format("a record of {} bytes, which are more than can be read", place.size));
      }
      return place.opcode == McapOpcode::kChunk
                 ? decompressed(bytes_.read(place.offset, place.size))
                 : bytes_.read(place.offset - kRecordHead, place.size + kRecordHead);
    });
  }

  /// The records in a chunk. @throws RecordError if they are damaged.
  static std::string decompressed(const std::string& chunk) {
    FieldReader fields(chunk);
    static_cast<void>(fields.take(2 * sizeof(std::uint64_t)));  // the times
    const auto size = fields.number<std::uint64_t>();
    const auto checksum = fields.number<std::uint32_t>();
    const std::string_view method = fields.text();
    const std::string_view stored = fields.take(fields.number<std::uint64_t>());
    if (size > kLargestMcapChunk) {
      throw RecordError(fmt::format("a chunk of {} bytes, more than the {} that can be read", size,
                                    kLargestMcapChunk));
    }
    std::optional<std::string> records;
    if (method.empty()) {
      records = std::string(stored);
    } else if (method == "zstd") {
      records = zstd_decompressed(stored, static_cast<std::size_t>(size));
    } else if (method == "lz4") {
      records = lz4_decompressed(stored, static_cast<std::size_t>(size));
    } else {
      throw RecordError(fmt::format("a chunk compressed by {:.20} (zstd, lz4 or none are read)",
                                    geometric::printable(method)));
    }
    if (!records || records->size() != size) {
      throw RecordError("a damaged chunk");
    }
    boost::crc_32_type computed;
    computed.process_bytes(records->data(), records->size());
    if (checksum != 0 && checksum != computed.checksum()) {
      throw RecordError("a chunk with another checksum");
    }
    return *std::move(records);
  }

  /// Passes the records in a part. @throws InputError if they are damaged.
  template <typename Pass>
  void for_records(const RecordPlace& place, std::string_view records, const Pass& pass) const {
    at_record(place, [&] {
      FieldReader all(records);
      while (!all.rest().empty()) {
        const auto opcode = static_cast<McapOpcode>(all.number<std::uint8_t>());
        pass(opcode, FieldReader(all.take(all.number<std::uint64_t>())));
      }
    });
  }

  /// Messages of some channels in the order of their times.
  [[nodiscard]] std::vector<TimedMessage> messages_in(
      const RecordPlace& place, std::string_view records,
      const std::set<std::uint16_t>& channels) const {
    std::vector<TimedMessage> messages;
    for_records(place, records, [&](McapOpcode opcode, FieldReader fields) {
      if (opcode != McapOpcode::kMessage || !channels.contains(fields.number<std::uint16_t>())) {
        return;
      }
      static_cast<void>(fields.number<std::uint32_t>());  // the sequence
      const auto received = fields.number<std::uint64_t>();
      static_cast<void>(fields.number<std::uint64_t>());  // the time of sending
      messages.push_back({received, fields.rest()});
    });
    std::ranges::stable_sort(messages, {}, &TimedMessage::received);
    return messages;
  }

  FileBytes bytes_;
  std::string head_;    ///< Beginning of the last record.
  std::string record_;  ///< Content of the last schema or channel.
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
};

}  // namespace

std::unique_ptr<BagStorage> open_mcap_bag(const fs::path& file) {
  return std::make_unique<McapBag>(file);
}

}  // namespace handway::device
