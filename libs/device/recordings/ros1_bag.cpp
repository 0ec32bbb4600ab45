#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/printable.h"
#include "recordings/bag_of_parts.h"
#include "recordings/decompression.h"
#include "recordings/file_bytes.h"
#include "recordings/record_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

// Source: ROS wiki, "Bags/Format/2.0".

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr const char* kWhatBag = "a bag of ROS 1 (format 2.0)";
constexpr std::string_view kRos1BagMagic = "#ROSBAG V2.0\n";
constexpr std::uint64_t kLargestBagHeader = std::uint64_t{1} << 20;    // bytes
constexpr std::uint64_t kLargestConnection = std::uint64_t{16} << 20;  // bytes
constexpr std::uint64_t kLargestBagChunk = std::uint64_t{256} << 20;   // bytes, in memory

/// Kinds of records.
enum class BagOpcode : std::uint8_t {
  kMessage = 0x02,
  kBagHeader = 0x03,
  kIndex = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07,
};

/// The header of a record: named fields, "NAME=VALUE".
class BagRecordHeader {
 public:
  /// @param bytes outlive the header. @throws RecordError if they are damaged.
  explicit BagRecordHeader(std::string_view bytes) {
    FieldReader fields(bytes);
    while (!fields.rest().empty()) {
      const std::string_view field = fields.text();
      const std::size_t sign = field.find('=');
      if (sign == std::string_view::npos) {
        throw RecordError("a field without a name");
      }
      fields_.emplace(field.substr(0, sign), field.substr(sign + 1));
    }
  }

  [[nodiscard]] std::string_view text(std::string_view name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? std::string_view() : found->second;
  }
  /// @throws RecordError if the field is missing or has another size.
  template <typename Number>
  [[nodiscard]] Number number(std::string_view name) const {
    const std::string_view value = text(name);
    if (value.size() != sizeof(Number)) {
      throw RecordError(fmt::format("a header without a valid field {}", name));
    }
    return FieldReader(value).number<Number>();
  }
  [[nodiscard]] BagOpcode opcode() const {
    return static_cast<BagOpcode>(number<std::uint8_t>("op"));
  }

 private:
  std::map<std::string_view, std::string_view> fields_;
};

/// A record in the file, with the place of its data.
struct BagRecordPlace {
  std::string header;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;  ///< Bytes.
};

/// Records of messages: a chunk, or a single message outside of chunks, as in a bag that was not
/// closed.
struct BagPart {
  BagRecordPlace place;
  bool is_chunk = false;
  std::map<std::uint32_t, std::uint64_t> counts;  ///< Messages by connection.
  bool is_indexed = false;                        ///< The counts are known.
};

/// A message in a part.
struct BagMessage {
  double received = 0.0;  ///< s since 1970
  std::string_view data;
};

double time_in(const BagRecordHeader& header) {
  const auto time = header.number<std::uint64_t>("time");  // seconds, then nanoseconds
  return static_cast<double>(time & 0xFFFFFFFFU) + 1e-9 * static_cast<double>(time >> 32U);
}

class Ros1Bag final : public BagOfParts<std::uint32_t, BagPart> {
 public:
  explicit Ros1Bag(const fs::path& file) : bytes_(file, kWhatBag) {
    if (bytes_.read(0, kRos1BagMagic.size()) != kRos1BagMagic) {
      throw InputError({file.string(), "", "a bag of another version, or a damaged beginning",
                        kWhatBag, "Convert an old bag by rosbag fix."});
    }
    find_records();
    for (BagPart& part : parts_) {
      if (!is_known(part)) {
        look_into(part);
      }
    }
  }

 protected:
  [[nodiscard]] std::map<std::uint32_t, BagTopic> connections() const override {
    return connections_;
  }

  void for_messages_of(const BagPart& part, const std::set<std::uint32_t>& connections,
                       const Take& take) const override {
    const std::string records = records_of(part);
    for (const BagMessage& message : messages_in(part, records, connections)) {
      take(message.data, message.received);
    }
  }

 private:
  /// Calls `read`, and names the file and the record in its errors.
  template <typename Read>
  auto at_record(std::uint64_t offset, const Read& read) const {
    try {
      return read();
    } catch (const RecordError& error) {
      throw InputError({bytes_.path().string(), fmt::format("record at byte {}", offset),
                        error.what(), kWhatBag, "Copy the file again, or run rosbag reindex."});
    }
  }

  /// The record at that place; nothing if the file ends before. @throws RecordError
  [[nodiscard]] std::optional<BagRecordPlace> record_at(std::uint64_t offset) const {
    constexpr std::uint64_t kBeginning = 256;  // bytes, which most headers don't exceed
    constexpr std::uint64_t kSize = sizeof(std::uint32_t);
    if (!bytes_.has(offset, kSize)) {
      return std::nullopt;
    }
    std::string head = bytes_.read(offset, kBeginning);
    const std::uint64_t header_size = FieldReader(head).number<std::uint32_t>();
    if (!bytes_.has(offset, kSize + header_size + kSize)) {
      return std::nullopt;
    }
    if (header_size > kLargestBagHeader) {
      throw RecordError(fmt::format("a header of {} bytes, more than can be read", header_size));
    }
    if (head.size() < kSize + header_size + kSize) {
      head = bytes_.read(offset, kSize + header_size + kSize);
    }
    FieldReader fields(head);
    BagRecordPlace place{std::string(fields.text()), 0, fields.number<std::uint32_t>()};
    place.offset = offset + kSize + header_size + kSize;
    return bytes_.has(place.offset, place.size) ? std::optional(std::move(place)) : std::nullopt;
  }

  /// Finds all records in the file without reading messages.
  void find_records() {
    std::uint64_t offset = kRos1BagMagic.size();
    while (offset < bytes_.size()) {
      const std::optional<BagRecordPlace> place =
          at_record(offset, [&] { return record_at(offset); });
      if (!place) {
        break;
      }
      at_record(offset, [&] { note_record(*place); });
      offset = place->offset + place->size;
    }
    if (offset < bytes_.size()) {
      warnings_.push_back(fmt::format("{}: the file is cut off: {} at its end left out",
                                      bytes_.path().string(),
                                      geometric::plural(bytes_.size() - offset, "byte")));
    }
  }

  void note_record(const BagRecordPlace& place) {
    const BagRecordHeader header(place.header);
    switch (header.opcode()) {
      case BagOpcode::kBagHeader:
        if (!header.text("encryptor").empty()) {
          throw RecordError("an encrypted bag");
        }
        break;
      case BagOpcode::kConnection:
        if (place.size > kLargestConnection) {
          throw RecordError(fmt::format("a record of {} bytes, more than can be read", place.size));
        }
        note_connection(header, bytes_.read(place.offset, place.size));
        break;
      case BagOpcode::kMessage:
        parts_.push_back({place, false, {{header.number<std::uint32_t>("conn"), 1}}, true});
        break;
      case BagOpcode::kChunk:
        parts_.push_back({place, true, {}, false});
        break;
      case BagOpcode::kIndex:
        note_index(header);
        break;
      default:
        break;
    }
  }

  /// @param data the fields of the connection: type, definition, …
  void note_connection(const BagRecordHeader& header, std::string_view data) {
    const BagRecordHeader fields(data);
    connections_.emplace(header.number<std::uint32_t>("conn"),
                         BagTopic{geometric::printable(header.text("topic")),
                                  geometric::printable(fields.text("type")), "ros1"});
  }

  /// Notes the messages of a connection in the chunk before.
  void note_index(const BagRecordHeader& header) {
    if (parts_.empty() || !parts_.back().is_chunk) {
      return;
    }
    if (const auto count = header.number<std::uint32_t>("count"); count > 0) {
      parts_.back().counts[header.number<std::uint32_t>("conn")] += count;
    }
    parts_.back().is_indexed = true;
  }

  /// Returns whether the contents of a part are known without decompressing it.
  [[nodiscard]] bool is_known(const BagPart& part) const {
    return part.is_indexed && std::ranges::all_of(part.counts, [this](const auto& count) {
             return connections_.contains(count.first);
           });
  }

  /// Finds connections and messages in a chunk.
  void look_into(BagPart& part) {
    if (!part.is_chunk) {
      return;
    }
    part.counts.clear();
    const std::string records = records_of(part);
    for_records(part, records, [&](const BagRecordHeader& header, std::string_view data) {
      if (header.opcode() == BagOpcode::kConnection) {
        note_connection(header, data);
      } else if (header.opcode() == BagOpcode::kMessage) {
        ++part.counts[header.number<std::uint32_t>("conn")];
      }
    });
  }

  /// The records in a part, decompressed; of a message its data alone.
  [[nodiscard]] std::string records_of(const BagPart& part) const {
    return at_record(part.place.offset, [&] {
      if (part.place.size > kLargestBagChunk) {
        throw RecordError(
            fmt::format("a record of {} bytes, which are more than can be read", part.place.size));
      }
      std::string data = bytes_.read(part.place.offset, part.place.size);
      return part.is_chunk ? decompressed(BagRecordHeader(part.place.header), std::move(data))
                           : std::move(data);
    });
  }

  /// The records in a chunk. @throws RecordError if they are damaged.
  static std::string decompressed(const BagRecordHeader& header, std::string stored) {
    const std::size_t size = header.number<std::uint32_t>("size");
    const std::string_view method = header.text("compression");
    if (size > kLargestBagChunk) {
      throw RecordError(fmt::format("a chunk of {} bytes, more than the {} that can be read", size,
                                    kLargestBagChunk));
    }
    std::optional<std::string> records;
    if (method == "none") {
      records = std::move(stored);
    } else if (method == "bz2") {
      records = bzip2_decompressed(stored, size);
    } else if (method == "lz4") {
      records = lz4_decompressed(stored, size);
    } else {
      throw RecordError(fmt::format("a chunk compressed by {:.20} (bz2, lz4 or none are read)",
                                    geometric::printable(method)));
    }
    if (!records || records->size() != size) {
      throw RecordError("a damaged chunk");
    }
    return *std::move(records);
  }

  /// Passes the records in a chunk. @throws InputError if they are damaged.
  template <typename Pass>
  void for_records(const BagPart& part, std::string_view records, const Pass& pass) const {
    at_record(part.place.offset, [&] {
      FieldReader all(records);
      while (!all.rest().empty()) {
        const BagRecordHeader header(all.text());
        pass(header, all.text());
      }
    });
  }

  /// Messages of some connections in the order of their times.
  [[nodiscard]] std::vector<BagMessage> messages_in(
      const BagPart& part, std::string_view records,
      const std::set<std::uint32_t>& connections) const {
    std::vector<BagMessage> messages;
    const auto add = [&](const BagRecordHeader& header, std::string_view data) {
      if (header.opcode() == BagOpcode::kMessage &&
          connections.contains(header.number<std::uint32_t>("conn"))) {
        messages.push_back({time_in(header), data});
      }
    };
    if (part.is_chunk) {
      for_records(part, records, add);
    } else {
      at_record(part.place.offset, [&] { add(BagRecordHeader(part.place.header), records); });
    }
    std::ranges::stable_sort(messages, {}, &BagMessage::received);
    return messages;
  }

  FileBytes bytes_;
  std::map<std::uint32_t, BagTopic> connections_;
};

}  // namespace

std::unique_ptr<BagStorage> open_ros1_bag(const fs::path& file) {
  return std::make_unique<Ros1Bag>(file);
}

}  // namespace handway::device
