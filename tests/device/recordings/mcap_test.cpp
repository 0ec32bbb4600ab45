/// Recordings in bags of ROS 2 in MCAP; also cut off and damaged.
#include "cdr_message.h"
#include "damaged_copies.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "ros1_message.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using test::joint_state;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kMagic = "\x89MCAP0\r\n";

template <typename Number>
std::string little_endian_bytes(Number number) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return bytes;
}

std::string u16(int value) { return little_endian_bytes(static_cast<std::uint16_t>(value)); }
std::string u32(std::size_t value) {
  return little_endian_bytes(static_cast<std::uint32_t>(value));
}
std::string u64(std::uint64_t value) { return little_endian_bytes(value); }
std::string text_field(const std::string& text) { return u32(text.size()) + text; }

std::string record(int opcode, const std::string& content) {
  return static_cast<char>(opcode) + u64(content.size()) + content;
}

std::string schema(int id, const std::string& name) {
  return record(3, u16(id) + text_field(name) + text_field("ros2msg") + text_field("# fields"));
}

std::string channel(int id, int schema, const std::string& topic,
                    const std::string& encoding = "cdr") {
  return record(4, u16(id) + u16(schema) + text_field(topic) + text_field(encoding) + u32(0));
}

std::string message(int channel, std::uint64_t time, const std::string& data) {
  return record(5, u16(channel) + u32(0) + u64(time) + u64(time) + data);
}

std::string compressed_records(const std::string& method, const std::string& records) {
  std::string frame(records.size() + 1000, '\0');
  if (method == "zstd") {
    return frame.substr(
        0, ZSTD_compress(frame.data(), frame.size(), records.data(), records.size(), 1));
  }
  if (method == "lz4") {
    return frame.substr(
        0, LZ4F_compressFrame(frame.data(), frame.size(), records.data(), records.size(), nullptr));
  }
  return records;
}

std::string chunk(const std::string& method, const std::string& records,
                  std::uint32_t checksum = 0) {
  const std::string stored = compressed_records(method, records);
  return record(6, u64(0) + u64(0) + u64(records.size()) + u32(checksum) + text_field(method) +
                       u64(stored.size()) + stored);
}

std::string message_index(int channel, std::size_t count) {
  return record(7, u16(channel) + u32(16 * count) + std::string(16 * count, '\0'));
}

std::string whole_file(const std::string& records) {
  return kMagic + record(1, text_field("ros2") + text_field("test")) + records +
         record(2, u64(0) + u64(0) + u32(0)) + kMagic;
}

const std::string kDefinitions = schema(1, "sensor_msgs/msg/JointState") +
                                 channel(7, 1, "/joint_states") +
                                 schema(2, "tf2_msgs/msg/TFMessage") + channel(8, 2, "/tf");

/// Messages of the first and the second half of a recording.
std::string first_messages() {
  return message(7, 1, joint_state(10.0, {"pan", "tilt"}, {0.1, 0.2})) + message(8, 2, "not read");
}
std::string last_messages() {
  return message(7, 4, joint_state(11.0, {"tilt", "pan"}, {0.4, 0.5})) +
         message(7, 3, joint_state(10.5, {"pan"}, {0.3}));  // out of order
}

/// A bag with indices behind its chunks, and definitions in its summary.
std::string indexed_bag(const std::string& method) {
  const std::string data = chunk(method, kDefinitions + first_messages()) + message_index(7, 1) +
                           message_index(8, 1) + chunk(method, last_messages()) +
                           message_index(7, 2) + record(0x0F, u32(0));
  return whole_file(data + kDefinitions + record(0x0B, std::string(42, '\0') + u32(0)));
}

class Mcap : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  test::ScratchFolder folder_;
};

std::string refusal_of_bag(const fs::path& file) {
  return test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); });
}

void expect_joints(const fs::path& file) {
  const RecordingContents contents = recording_contents(file);
  EXPECT_EQ(contents.kind.name, "ROS 2 bag");
  ASSERT_EQ(contents.variables.size(), 2U);
  EXPECT_EQ(to_string(contents.variables[0]), "/joint_states (3 x 2)");
  EXPECT_EQ(to_string(contents.variables[1]), "/tf (1)");
  EXPECT_THAT(contents.variables[1].problem, HasSubstr("tf2_msgs"));
  const RecordedTable table = read_recorded_table(file);
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.2}, {0.5, 0.4}}));
  EXPECT_NEAR(table.times[2], 1.0, 1e-9);
  EXPECT_THAT(table.warnings, testing::IsEmpty());
}

TEST_F(Mcap, ChunksAreReadWithEveryCompression) {
  for (const char* method : {"", "zstd", "lz4"}) {
    SCOPED_TRACE(method);
    expect_joints(write("indexed.mcap", indexed_bag(method)));
    expect_joints(
        write("without_index.mcap", whole_file(chunk(method, kDefinitions + first_messages()) +
                                               chunk(method, last_messages()))));
  }
}

TEST_F(Mcap, MessagesOutsideOfChunksAreRead) {
  expect_joints(write("bag.mcap",
                      whole_file(kDefinitions + first_messages() + chunk("lz4", last_messages()))));
}

TEST_F(Mcap, BagsInSeveralFilesAreReadByTheirFolder) {
  write("bag/metadata.yaml", "rosbag2_bagfile_information: {}\n");
  write("bag/bag_0.mcap", whole_file(chunk("zstd", kDefinitions + first_messages())));
  write("bag/bag_1.mcap", whole_file(chunk("zstd", kDefinitions + last_messages())));
  expect_joints(folder_.path() / "bag");
}

// This file was written by the library @mcap/core.
TEST_F(Mcap, FilesOfOtherWritersAreRead) {
  std::ifstream stream(test::source_dir() / "tests/fuzz/corpora/recorded_mcap/mcap_core",
                       std::ios::binary);
  expect_joints(write("bag.mcap", {std::istreambuf_iterator<char>(stream), {}}));
}

TEST_F(Mcap, ABagThatIsCutOffIsReadUpToItsEnd) {
  const std::string bytes = indexed_bag("zstd");
  const std::string begin = kMagic + record(1, text_field("ros2") + text_field("test")) +
                            chunk("zstd", kDefinitions + first_messages());
  ASSERT_TRUE(bytes.starts_with(begin));
  const RecordedTable table = read_recorded_table(
      write("bag.mcap", bytes.substr(0, begin.size() + 4)).string() + "#/joint_states");
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.1, 0.2}}));
  EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("cut off"), HasSubstr("4 bytes"))));
}

TEST_F(Mcap, OtherEncodingsAreNamed) {
  const fs::path file =
      write("bag.mcap", whole_file(schema(1, "sensor_msgs/msg/JointState") +
                                   channel(7, 1, "/joint_states", "json") + message(7, 1, "{}")));
  EXPECT_EQ(recording_contents(file).variables.at(0).problem, "messages encoded as json");
}

TEST_F(Mcap, MessagesOfRos1AreRead) {
  const RecordedTable table = read_recorded_table(write(
      "bag.mcap",
      whole_file(schema(1, "sensor_msgs/JointState") + channel(7, 1, "/joint_states", "ros1") +
                 message(7, 1, test::ros1_joint_state(2.0, {"pan", "tilt"}, {0.5, 0.1})) +
                 message(7, 2, test::ros1_joint_state(3.0, {"pan"}, {0.6})))));
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.5, 0.1}, {0.6, 0.1}}));
}

TEST_F(Mcap, DamagedRecordsAreRefusedByTheirPlace) {
  const std::string records = kDefinitions + first_messages();
  const std::size_t place = whole_file("").size() - 2 * kMagic.size() - 29 + kMagic.size() + 9;
  const auto refusal = [&](const std::string& damaged) {
    return refusal_of_bag(write("bag.mcap", whole_file(damaged)));
  };
  EXPECT_EQ(refusal(chunk("bz2", records)),
            fmt::format("{}: record at byte {}: found a chunk compressed by bz2 (zstd, lz4 or none "
                        "are read), expected a bag of ROS 2 in MCAP. Copy the file again, or run "
                        "mcap recover.",
                        (folder_.path() / "bag.mcap").string(), place));
  EXPECT_THAT(refusal(chunk("", records, 1234)), HasSubstr("checksum"));
  EXPECT_THAT(refusal(chunk("", records.substr(0, records.size() - 5))),
              HasSubstr("an end within a field"));
  std::string huge = chunk("zstd", records);
  huge.replace(9 + 16, 8, u64(std::uint64_t{1} << 60));
  EXPECT_THAT(refusal(huge), HasSubstr("a chunk of 1152921504606846976 bytes"));
  huge.replace(9 + 16, 8, u64(std::uint64_t{200} << 20));
  EXPECT_THAT(refusal(huge), HasSubstr("a damaged chunk"));
}

TEST_F(Mcap, FilesThatAreNotMcapAreRefused) {
  for (const std::string& bytes :
       {std::string(), std::string("SQLite?"), kMagic.substr(0, 5), std::string("\x89MCAP1\r\n"),
        kMagic, kMagic + record(6, "") + std::string(9, '\xFF')}) {
    const fs::path file = write("a.mcap", bytes);
    EXPECT_THAT(refusal_of_bag(file), HasSubstr(file.string())) << bytes;
  }
}

TEST_F(Mcap, NamesThatAreNotUtf8AreShownAsText) {
  const fs::path file = write(
      "bag.mcap", whole_file(schema(1, "sensor_msgs/msg/JointState") + channel(7, 1, "/j\xFF") +
                             message(7, 1, joint_state(1.0, {"pan"}, {0.5}))));
  EXPECT_EQ(recording_contents(file).variables.at(0).name, "/j\\ufffd");
}

TEST_F(Mcap, AnyDamageIsSurvived) {
  for (const char* method : {"", "lz4"}) {
    test::for_damaged_copies(indexed_bag(method), [&](const std::string& bytes) {
      const fs::path file = write("d.mcap", bytes);
      static_cast<void>(test::refusal_of([&] {
        static_cast<void>(recording_contents(file));
        static_cast<void>(read_recorded_table(file));
      }));
    });
  }
}

TEST_F(Mcap, IsWrittenWithPosesAsTopicsOfTheirOwn) {
  RecordedTable table;
  table.names = {"pan",     "palm.x",  "palm.y",  "palm.z", "palm.qx",
                 "palm.qy", "palm.qz", "palm.qw", "tilt",   "alone.x"};
  table.times = Eigen::Vector2d(0.5, 1.25);
  table.values = Eigen::MatrixXd::Random(2, 10);
  const fs::path file = folder_.path() / "poses.mcap";
  write_recorded_table(table, file);
  const RecordingContents contents = recording_contents(file);
  ASSERT_EQ(contents.variables.size(), 2U);
  EXPECT_EQ(contents.variables[0].name, "/joint_states");
  EXPECT_EQ(contents.variables[1].name, "/palm");
  EXPECT_EQ(to_string(contents.variables[1]), "/palm (2 x 7)");
  const RecordedTable palm = read_recorded_table(file.string() + "#/palm");
  EXPECT_THAT(palm.names, ElementsAre("palm.x", "palm.y", "palm.z", "palm.qx", "palm.qy", "palm.qz",
                                      "palm.qw"));
  EXPECT_EQ(palm.values, table.values.middleCols(1, 7));
  const RecordedTable read = read_recorded_table(file);
  EXPECT_THAT(read.names, ElementsAre("pan", "tilt", "alone.x"));
  EXPECT_EQ(read.values.col(1), table.values.col(8));
  EXPECT_NEAR(read.times[1], 0.75, 1e-9);
}

// A marker of ROS 2, before Humble or since then.
void add_marker(test::CdrMessage& array, const std::string& space, int type,
                const Eigen::Vector3d& position, bool is_humble) {
  array.stamp(3.0);
  array.text(space);
  for (const int number : {7, type, 0}) {
    array.number(static_cast<std::int32_t>(number));
  }
  for (const double number : {position.x(), position.y(), position.z(), 0.0, 0.0, 0.0, 1.0}) {
    array.number(number);
  }
  for (int i = 0; i < 3; ++i) {
    array.number(0.01);
  }
  for (int i = 0; i < 4; ++i) {
    array.number(1.0F);
  }
  array.number(std::int32_t{0});
  array.number(std::uint32_t{0});
  array.number(std::uint8_t{0});
  array.number(std::uint32_t{0});  // points
  array.number(std::uint32_t{1});  // colors
  for (int i = 0; i < 4; ++i) {
    array.number(0.5F);
  }
  if (is_humble) {
    array.text("");
    array.stamp(0.0);
    array.text("png");
    array.number(std::uint32_t{3});
    for (int i = 0; i < 3; ++i) {
      array.number(std::uint8_t{9});
    }
    array.number(std::uint32_t{0});
  }
  array.text("a label");
  array.text("");
  if (is_humble) {
    array.text("");
    array.number(std::uint32_t{0});
  }
  array.number(std::uint8_t{0});
}

TEST_F(Mcap, MarkersOfAHandAreLandmarks) {
  GloveAngles bent;
  bent.angles.fill(0.3);
  const HandLandmarks points = hand_landmarks(bent);
  constexpr int kSphere = 2;
  constexpr int kText = 9;
  for (const bool is_humble : {false, true}) {
    test::CdrMessage array;
    array.number(std::uint32_t{23});
    add_marker(array, "names", kText, Eigen::Vector3d::Zero(), is_humble);
    for (int i = 0; i < 21; ++i) {
      add_marker(array, "hand", kSphere, points.col(i), is_humble);
    }
    add_marker(array, "other", kSphere, Eigen::Vector3d::Zero(), is_humble);
    const std::string frame = array.encapsulated();
    const fs::path file =
        write("bag.mcap",
              whole_file(schema(1, "visualization_msgs/msg/MarkerArray") + channel(7, 1, "/hand") +
                         message(7, 1'000'000'000, frame) + message(7, 2'000'000'000, frame) +
                         schema(2, "visualization_msgs/msg/MarkerArray") + channel(8, 2, "/rooms") +
                         message(8, 1, std::string("\0\1\0\0\1\0\0\0", 8))));
    EXPECT_THAT(recording_contents(file).variables.at(1).problem, HasSubstr("can't be read"));
    const Recording recording = read_recording(file);
    ASSERT_EQ(recording.times.size(), 2);
    const int sensor = *find_sensor("RingPIJ");
    EXPECT_NEAR(
        recording.values(1, column_of(recording.header, sensor)),
        glove_angles(in_palm_frame(points, false)).angles.at(static_cast<std::size_t>(sensor)),
        1e-6);
  }
}

TEST_F(Mcap, IsWrittenInChunksThatAreRead) {
  RecordedTable table;
  table.names = {"a", "b", "c"};
  constexpr Eigen::Index kRows = 30000;
  table.times = Eigen::VectorXd::LinSpaced(kRows, 0.0, 300.0);
  table.values = Eigen::MatrixXd::Random(kRows, 3);
  const fs::path file = folder_.path() / "long.mcap";
  write_recorded_table(table, file);
  EXPECT_GT(fs::file_size(file), 2'000'000U) << "bytes, several chunks";
  EXPECT_EQ(read_recorded_table(file).values, table.values);
}

}  // namespace
}  // namespace handway::device
