/// Recordings in bags of ROS 1; also cut off and damaged.
#include "damaged_copies.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "ros1_message.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace handway::device::ros1 {  // tests of other bags have functions of the same names
namespace {

namespace fs = std::filesystem;
using test::ros1_joint_state;
using test::Ros1Message;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kMagic = "#ROSBAG V2.0\n";

template <typename Number>
std::string little_endian(Number number) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return bytes;
}

std::string u32(std::size_t value) { return little_endian(static_cast<std::uint32_t>(value)); }
std::string u64(std::uint64_t value) { return little_endian(value); }
std::string sized(const std::string& bytes) { return u32(bytes.size()) + bytes; }

using Fields = std::vector<std::pair<std::string, std::string>>;

std::string header_of(const Fields& fields) {
  std::string bytes;
  for (const auto& [name, value] : fields) {
    bytes += sized(name + "=" + value);
  }
  return bytes;
}

std::string record(int opcode, Fields fields, const std::string& data) {
  fields.emplace_back("op", std::string(1, static_cast<char>(opcode)));
  return sized(header_of(fields)) + sized(data);
}

std::string bag_header(const Fields& more = {}) {
  Fields fields{{"index_pos", u64(0)}, {"conn_count", u32(2)}, {"chunk_count", u32(1)}};
  fields.insert(fields.end(), more.begin(), more.end());
  return record(3, fields, std::string(100, ' '));
}

std::string connection(int id, const std::string& topic, const std::string& type) {
  return record(7, {{"conn", u32(static_cast<std::size_t>(id))}, {"topic", topic}},
                header_of({{"topic", topic},
                           {"type", type},
                           {"md5sum", "*"},
                           {"message_definition", "# a=b\nfloat64 x\n"}}));
}

std::string message(int connection, double time, const std::string& data) {
  Ros1Message stamp;
  stamp.time(time);
  return record(2, {{"conn", u32(static_cast<std::size_t>(connection))}, {"time", stamp.bytes()}},
                data);
}

std::string compressed(const std::string& method, const std::string& records) {
  std::string stored(2 * records.size() + 1000, '\0');
  if (method == "bz2") {
    auto size = static_cast<unsigned>(stored.size());
    std::string copy = records;
    EXPECT_EQ(BZ2_bzBuffToBuffCompress(stored.data(), &size, copy.data(),
                                       static_cast<unsigned>(copy.size()), 9, 0, 0),
              BZ_OK);
    return stored.substr(0, size);
  }
  if (method == "lz4") {
    return stored.substr(0, LZ4F_compressFrame(stored.data(), stored.size(), records.data(),
                                               records.size(), nullptr));
  }
  return records;
}

std::string chunk(const std::string& method, const std::string& records) {
  return record(5, {{"compression", method}, {"size", u32(records.size())}},
                compressed(method, records));
}

std::string index_of(int connection, std::size_t count) {
  return record(
      4,
      {{"ver", u32(1)}, {"conn", u32(static_cast<std::size_t>(connection))}, {"count", u32(count)}},
      std::string(12 * count, '\0'));
}

const std::string kConnections =
    connection(0, "/joint_states", "sensor_msgs/JointState") + connection(4, "/tf", "tf/tfMessage");

std::string first_messages() {
  return message(0, 1.0, ros1_joint_state(10.0, {"pan", "tilt"}, {0.1, 0.2})) +
         message(4, 2.0, "not read");
}
std::string last_messages() {
  return message(0, 4.0, ros1_joint_state(11.0, {"tilt", "pan"}, {0.4, 0.5})) +
         message(0, 3.0, ros1_joint_state(10.5, {"pan"}, {0.3}));  // out of order
}

/// A bag as rosbag writes it, with indices behind its chunks and the connections at its end.
std::string whole_bag(const std::string& method) {
  return kMagic + bag_header() + chunk(method, kConnections + first_messages()) + index_of(0, 1) +
         index_of(4, 1) + chunk(method, last_messages()) + index_of(0, 2) + kConnections +
         record(6, {{"ver", u32(1)}, {"count", u32(2)}}, std::string(16, '\0'));
}

class Ros1Bag : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  [[nodiscard]] std::string refusal(const std::string& bytes) const {
    const fs::path file = write("bag.bag", bytes);
    return test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); });
  }

  test::ScratchFolder folder_;
};

void expect_joints(const fs::path& file) {
  const RecordingContents contents = recording_contents(file);
  EXPECT_EQ(contents.kind.name, "ROS 1 bag");
  ASSERT_EQ(contents.variables.size(), 2U);
  EXPECT_EQ(to_string(contents.variables[0]), "/joint_states (3 x 2)");
  EXPECT_EQ(to_string(contents.variables[1]), "/tf (1)");
  EXPECT_THAT(contents.variables[1].problem, HasSubstr("tf/tfMessage"));
  const RecordedTable table = read_recorded_table(file);
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.2}, {0.5, 0.4}}));
  EXPECT_NEAR(table.times[2], 1.0, 1e-9);
  EXPECT_THAT(table.warnings, IsEmpty());
}

TEST_F(Ros1Bag, IsReadWithEveryCompression) {
  for (const char* method : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(method);
    expect_joints(write("bag.bag", whole_bag(method)));
    expect_joints(write("no_index.bag", kMagic + bag_header() +
                                            chunk(method, kConnections + first_messages()) +
                                            chunk(method, last_messages())));
  }
}

// While a bag is written, its last chunk has no size.
TEST_F(Ros1Bag, ThatWasNotClosedIsRead) {
  const std::string open = record(5, {{"compression", "none"}, {"size", u32(0)}}, "");
  expect_joints(write("bag.bag.active",
                      kMagic + bag_header() + chunk("lz4", kConnections + first_messages()) +
                          index_of(0, 1) + index_of(4, 1) + open +
                          message(0, 3.0, ros1_joint_state(10.5, {"pan"}, {0.3})) +
                          message(0, 4.0, ros1_joint_state(11.0, {"tilt", "pan"}, {0.4, 0.5}))));
}

TEST_F(Ros1Bag, ThatIsCutOffIsReadUpToItsEnd) {
  const std::string begin = kMagic + bag_header() + chunk("bz2", kConnections + first_messages());
  const std::string bytes = whole_bag("bz2");
  ASSERT_TRUE(bytes.starts_with(begin));
  const RecordedTable table = read_recorded_table(
      write("bag.bag", bytes.substr(0, begin.size() + 5)).string() + "#/joint_states");
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.1, 0.2}}));
  EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("cut off"), HasSubstr("5 bytes"))));
}

TEST_F(Ros1Bag, HasTheTimesOfReceptionForMessagesWithoutAStamp) {
  const fs::path file = write(
      "bag.bag",
      kMagic + bag_header() +
          chunk("none",
                kConnections +
                    message(0, 1.5e9, ros1_joint_state(0.0, {"pan", "tilt"}, {0.1, 0.3})) +
                    message(0, 1.5e9 + 0.25, ros1_joint_state(0.0, {"pan", "tilt"}, {0.2, 0.3}))));
  const RecordedTable table = read_recorded_table(file);
  EXPECT_NEAR(table.times[1] - table.times[0], 0.25, 1e-6);
}

TEST_F(Ros1Bag, OfTrajectoriesHasARowForEachPoint) {
  Ros1Message trajectory;
  trajectory.header(20.0, "odd");
  trajectory.texts({"pan", "tilt"});
  trajectory.count(2);
  for (const double at : {0.0, 0.5}) {
    trajectory.numbers({at, 1.0 - at});
    trajectory.numbers({1.0, -1.0});
    trajectory.numbers({});
    trajectory.numbers({});
    trajectory.time(2.0 * at);
  }
  const fs::path file = write(
      "bag.bag", kMagic + bag_header() +
                     chunk("lz4", connection(1, "/command", "trajectory_msgs/JointTrajectory") +
                                      message(1, 20.0, trajectory.bytes())));
  const RecordedTable table = read_recorded_table(file);
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.0, 1.0}, {0.5, 0.5}}));
  EXPECT_NEAR(table.times[1] - table.times[0], 1.0, 1e-9);
}

TEST_F(Ros1Bag, OfPosesHasLandmarksOfAHand) {
  GloveAngles bent;
  bent.angles.fill(0.3);
  const HandLandmarks points = hand_landmarks(bent);
  std::string messages;
  for (int frame = 0; frame < 3; ++frame) {
    Ros1Message poses;
    poses.header(30.0 + 0.1 * frame, "camera");
    poses.count(21);
    for (int i = 0; i < 21; ++i) {
      for (const double number : {points(0, i), points(1, i), points(2, i), 0.0, 0.0, 0.0, 1.0}) {
        poses.number(number);
      }
    }
    messages += message(2, 30.0, poses.bytes());
  }
  const fs::path file = write(
      "bag.bag", kMagic + bag_header() +
                     chunk("bz2", connection(2, "/hand", "geometry_msgs/PoseArray") + messages));
  const Recording recording = read_recording(file);
  ASSERT_EQ(recording.times.size(), 3);
  EXPECT_NEAR(recording.times[2], 0.2, 1e-6);
  const int sensor = *find_sensor("IndexPIJ");
  EXPECT_NEAR(
      recording.values(2, column_of(recording.header, sensor)),
      glove_angles(in_palm_frame(points, false)).angles.at(static_cast<std::size_t>(sensor)), 1e-6);
}

TEST_F(Ros1Bag, OfTransformsHasTheFramesAsColumns) {
  const auto transforms = [](double stamp, const std::vector<std::string>& frames, double x) {
    Ros1Message message;
    message.count(frames.size());
    for (const std::string& frame : frames) {
      message.header(stamp, "world");
      message.text(frame);
      for (const double number : {x, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0}) {
        message.number(number);
      }
    }
    return message.bytes();
  };
  const std::string messages = message(4, 1.0, transforms(10.0, {"wrist", "camera"}, 0.1)) +
                               message(4, 2.0, transforms(10.5, {"wrist"}, 0.4));
  for (const char* type : {"tf/tfMessage", "tf2_msgs/TFMessage"}) {
    const fs::path file = write(
        "bag.bag", kMagic + bag_header() + chunk("none", connection(4, "/tf", type) + messages));
    const RecordedTable table = read_recorded_table(file);
    ASSERT_EQ(table.names.size(), 14U);
    EXPECT_EQ(table.names.front(), "wrist.x");
    EXPECT_EQ(table.names.back(), "camera.qw");
    EXPECT_EQ(table.values.col(0), Eigen::Vector2d(0.1, 0.4));
    EXPECT_EQ(table.values.col(7), Eigen::Vector2d(0.1, 0.1)) << "the camera keeps its place";
    EXPECT_NEAR(table.times[1], 0.5, 1e-9);
  }
  // Beside joints, poses are read by their name only.
  const fs::path both = write(
      "bag.bag",
      kMagic + bag_header() +
          chunk("none", kConnections + messages +
                            message(0, 1.0, ros1_joint_state(10.0, {"pan", "tilt"}, {0.1, 0.2})) +
                            message(0, 2.0, ros1_joint_state(10.1, {"pan", "tilt"}, {0.1, 0.3}))));
  EXPECT_THAT(read_recorded_table(both).names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(read_recorded_table(both.string() + "#/tf[0:7]").names.front(), "wrist.x");
}

TEST_F(Ros1Bag, OfMarkersHasLandmarksOfAHand) {
  GloveAngles bent;
  bent.angles.fill(0.3);
  const HandLandmarks points = hand_landmarks(bent);
  Ros1Message array;  // one marker with 21 points
  array.count(1);
  array.header(30.0);
  array.text("hand");
  for (const int number : {0, 7, 0}) {
    array.number(static_cast<std::int32_t>(number));
  }
  for (int i = 0; i < 10; ++i) {
    array.number(0.0);  // pose and scale
  }
  for (int i = 0; i < 4; ++i) {
    array.number(1.0F);
  }
  array.time(0.0);
  array.number(std::uint8_t{0});
  array.count(21);
  for (const double coordinate : points.reshaped()) {
    array.number(coordinate);
  }
  array.count(0);
  array.text("");
  array.text("");
  array.number(std::uint8_t{0});
  const fs::path file =
      write("bag.bag",
            kMagic + bag_header() +
                chunk("none", connection(2, "/hand", "visualization_msgs/MarkerArray") +
                                  message(2, 1.0, array.bytes()) + message(2, 2.0, array.bytes())));
  const Recording recording = read_recording(file);
  const int sensor = *find_sensor("MiddleMPJ");
  EXPECT_NEAR(
      recording.values(1, column_of(recording.header, sensor)),
      glove_angles(in_palm_frame(points, false)).angles.at(static_cast<std::size_t>(sensor)), 1e-6);
}

TEST_F(Ros1Bag, OfOtherVersionsAndKindsIsRefused) {
  EXPECT_THAT(refusal("#ROSBAG V1.2\n" + whole_bag("none").substr(kMagic.size())),
              AllOf(HasSubstr("bag.bag"), HasSubstr("another version"), HasSubstr("rosbag fix")));
  EXPECT_THAT(refusal(kMagic + bag_header({{"encryptor", "rosbag/AesCbcEncryptor"}})),
              HasSubstr("encrypted"));
  EXPECT_EQ(
      refusal(kMagic + chunk("zip", kConnections)),
      fmt::format("{}: record at byte {}: found a chunk compressed by zip (bz2, lz4 or none are "
                  "read), expected a bag of ROS 1 (format 2.0). Copy the file again, or run rosbag "
                  "reindex.",
                  (folder_.path() / "bag.bag").string(),
                  kMagic.size() + chunk("zip", kConnections).size() - kConnections.size()));
}

TEST_F(Ros1Bag, ThatIsDamagedIsRefusedByThePlace) {
  const std::string records = kConnections + first_messages();
  EXPECT_THAT(refusal(kMagic + chunk("none", records.substr(0, records.size() - 3))),
              HasSubstr("an end within a field"));
  const auto sized_chunk = [&](const std::string& method, std::size_t size) {
    return record(5, {{"compression", method}, {"size", u32(size)}}, compressed(method, records));
  };
  for (const char* method : {"none", "bz2", "lz4"}) {
    EXPECT_THAT(refusal(kMagic + sized_chunk(method, records.size() + 1)),
                HasSubstr("a damaged chunk"))
        << method;
    EXPECT_THAT(refusal(kMagic + sized_chunk(method, records.size() - 1)),
                HasSubstr("a damaged chunk"))
        << method;
  }
  EXPECT_THAT(refusal(kMagic + sized_chunk("bz2", 0xF0000000U)),
              HasSubstr("a chunk of 4026531840 bytes"));
  EXPECT_THAT(refusal(kMagic + sized(header_of({{"conn", u32(0)}})) + sized("")),
              HasSubstr("field op"));
  EXPECT_THAT(refusal(kMagic + sized(sized("no sign")) + sized("")), HasSubstr("without a name"));
  EXPECT_THAT(
      refusal(
          kMagic +
          chunk("none", kConnections +
                            message(0, 1.0, ros1_joint_state(1.0, {"pan"}, {0.1}).substr(0, 30)))),
      HasSubstr("/joint_states, message 1"));
}

TEST_F(Ros1Bag, SurvivesAnyDamage) {
  for (const char* method : {"none", "bz2"}) {
    test::for_damaged_copies(whole_bag(method), [&](const std::string& bytes) {
      const fs::path file = write("d.bag", bytes);
      static_cast<void>(test::refusal_of([&] {
        static_cast<void>(recording_contents(file));
        static_cast<void>(read_recorded_table(file));
      }));
    });
  }
}

// The fuzz target begins with this bag.
TEST_F(Ros1Bag, OfTheCorpusIsRead) {
  std::ifstream stream(test::source_dir() / "tests/fuzz/corpora/recorded_ros1_bag/topics",
                       std::ios::binary);
  expect_joints(write("bag.bag", {std::istreambuf_iterator<char>(stream), {}}));
}

}  // namespace
}  // namespace handway::device::ros1
