/// Recordings in data sets of LeRobot and tables in Parquet; also cut off and damaged.
#include "damaged_copies.h"
#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "parquet_writer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using test::ParquetStyle;
using test::WrittenColumn;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kInfo = R"({
  "codebase_version": "VERSION", "fps": 10,
  "features": {
    "observation.state": {"dtype": "float32", "shape": [2], "names": NAMES},
    "action": {"dtype": "float32", "shape": [2], "names": null},
    "observation.images.top": {"dtype": "video", "shape": [480, 640, 3], "names": ["h", "w", "c"]},
    "timestamp": {"dtype": "float32", "shape": [1], "names": null},
    "episode_index": {"dtype": "int64", "shape": [1], "names": null}
  }
})";

/// An episode and its number of frames.
struct WrittenEpisode {
  int number = 0;
  int frames = 0;
};

/// The states of an episode that write_frames() writes.
double state_of(int episode, int frame, int joint) { return episode + 0.125 * frame - 0.5 * joint; }

std::vector<WrittenColumn> columns_of_frames(const std::vector<WrittenEpisode>& episodes) {
  using Type = WrittenColumn::Type;
  std::vector<WrittenColumn> columns{{"observation.state", Type::kFloat, 2, {}, true},
                                     {"action", Type::kFloat, 2, {}},
                                     {"timestamp", Type::kFloat, 0, {}},
                                     {"episode_index", Type::kInt64, 0, {}, true},
                                     {"next.done", Type::kBool, 0, {}}};
  for (const WrittenEpisode& episode : episodes) {
    for (int frame = 0; frame < episode.frames; ++frame) {
      columns[0].values.insert(columns[0].values.end(), {state_of(episode.number, frame, 0),
                                                         state_of(episode.number, frame, 1)});
      columns[1].values.insert(columns[1].values.end(), {1.0, 2.0});
      columns[2].values.emplace_back(0.1 * frame);
      columns[3].values.emplace_back(episode.number);
      columns[4].values.emplace_back(frame + 1 == episode.frames ? 1.0 : 0.0);
    }
  }
  return columns;
}

std::string with(std::string text, const std::string& word, const std::string& replacement) {
  return text.replace(text.find(word), word.size(), replacement);
}

class LeRobot : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  void write_info(const std::string& version, const std::string& names) {
    write("meta/info.json", with(with(kInfo, "VERSION", version), "NAMES", names));
  }
  void write_version_2() {
    write_info("v2.1", R"({"motors": ["pan", "tilt"]})");
    write("meta/episodes.jsonl",
          "{\"episode_index\": 0, \"tasks\": [\"pick\"], \"length\": 4}\n"
          "{\"episode_index\": 1, \"tasks\": [\"pick\"], \"length\": 3}\n"
          "{\"episode_index\": 2, \"tasks\": [\"pick\"], \"length\": 9}\n");  // not downloaded
    write("data/chunk-000/episode_000000.parquet",
          test::parquet_bytes(columns_of_frames({{0, 4}})));
    write("data/chunk-000/episode_000001.parquet",
          test::parquet_bytes(columns_of_frames({{1, 3}})));
  }
  void write_version_3() {
    using Type = WrittenColumn::Type;
    write_info("v3.0", R"(["pan", "tilt"])");
    write("meta/episodes/chunk-000/file-000.parquet",
          test::parquet_bytes({{"episode_index", Type::kInt64, 0, {0, 1, 2}},
                               {"length", Type::kInt64, 0, {4, 3, 2}},
                               {"data/chunk_index", Type::kInt64, 0, {0, 0, 0}},
                               {"data/file_index", Type::kInt64, 0, {0, 0, 1}}}));
    write("data/chunk-000/file-000.parquet",
          test::parquet_bytes(columns_of_frames({{0, 4}, {1, 3}}), {2, 6, 0, 3}));
    write("data/chunk-000/file-001.parquet", test::parquet_bytes(columns_of_frames({{2, 2}})));
  }
  [[nodiscard]] std::string data_set() const { return folder_.path().string(); }

  test::ScratchFolder folder_;
};

std::vector<std::string> variable_names(const fs::path& file) {
  std::vector<std::string> names;
  std::ranges::transform(recording_contents(file).variables, std::back_inserter(names),
                         [](const RecordingVariable& variable) { return to_string(variable); });
  return names;
}

std::string content_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string refusal_of_table(const fs::path& file) {
  return test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); });
}

void expect_episode(const RecordedTable& table, int episode, int frames) {
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  ASSERT_EQ(table.values.rows(), frames);
  for (int frame = 0; frame < frames; ++frame) {
    EXPECT_EQ(table.values(frame, 0), state_of(episode, frame, 0));
    EXPECT_EQ(table.values(frame, 1), state_of(episode, frame, 1));
    EXPECT_NEAR(table.times[frame], 0.1 * frame, 1e-6);
  }
}

TEST_F(LeRobot, EpisodesOfVersion2AreVariablesWithNamesAndTimes) {
  write_version_2();
  EXPECT_EQ(recording_contents(data_set()).kind.name, "LeRobot");
  EXPECT_TRUE(is_recording(data_set()));
  EXPECT_THAT(variable_names(data_set()),
              ElementsAre("observation.state (7 x 2)", "action (7 x 2)", "timestamp (7)",
                          "next.done (7)", "observation.images.top (7 x 480 x 640 x 3)",
                          "episode_0/observation.state (4 x 2)", "episode_0/action (4 x 2)",
                          "episode_0/timestamp (4)", "episode_0/next.done (4)",
                          "episode_1/observation.state (3 x 2)", "episode_1/action (3 x 2)",
                          "episode_1/timestamp (3)", "episode_1/next.done (3)"));
  for (const char* place : {"", "/meta/info.json"}) {
    expect_episode(read_recorded_table(data_set() + place + "#episode_1/observation.state"), 1, 3);
  }
  const RecordedTable done = read_recorded_table(data_set() + "#episode_1/next.done");
  EXPECT_EQ(done.values, Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(refusal_of_table(data_set() + "#observation.images.top"), HasSubstr("pictures"));
}

TEST_F(LeRobot, EpisodesOfVersion3AreFoundInTheirFile) {
  write_version_3();
  for (int episode = 0; episode < 3; ++episode) {
    const std::string name = fmt::format("#episode_{}/observation.state", episode);
    expect_episode(read_recorded_table(data_set() + name), episode, 4 - episode);
  }
  const std::string file = data_set() + "/data/chunk-000/file-000.parquet";
  expect_episode(read_recorded_table(file + "#episode_1/observation.state"), 1, 3);
}

TEST_F(LeRobot, EpisodesAreFoundWithoutTheirList) {
  write_version_3();
  fs::remove_all(folder_.path() / "meta" / "episodes");
  EXPECT_EQ(variable_names(data_set()).size(), 5U + 3U * 4U);
  expect_episode(read_recorded_table(data_set() + "#episode_2/observation.state"), 2, 2);
}

TEST_F(LeRobot, StatesOfAllEpisodesAreReadUnlessOneIsChosen) {
  write_version_3();
  const RecordedTable table = read_recorded_table(data_set());
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  ASSERT_EQ(table.values.rows(), 9);
  EXPECT_EQ(table.values(4, 0), state_of(1, 0, 0));
  EXPECT_EQ(table.values(8, 1), state_of(2, 1, 1));
  for (int row = 0; row < 9; ++row) {
    EXPECT_NEAR(table.times[row], 0.1 * row, 1e-6);
  }
  EXPECT_THAT(table.warnings, ElementsAre(HasSubstr("3 episodes one after the other")));
}

TEST_F(LeRobot, AFileAloneIsReadWithoutItsDataSet) {
  const fs::path file =
      write("somewhere.parquet", test::parquet_bytes(columns_of_frames({{5, 3}})));
  EXPECT_THAT(variable_names(file),
              ElementsAre("episode_5/observation.state (3 x 2)", "episode_5/action (3 x 2)",
                          "episode_5/timestamp (3)", "episode_5/next.done (3)"));
  EXPECT_EQ(read_recorded_table(file).values(2, 1), state_of(5, 2, 1));
}

TEST_F(LeRobot, NamesMayBeGivenByIndex) {
  write_version_2();
  write_info("v2.1", R"({"tilt": 1, "pan": 0})");
  expect_episode(read_recorded_table(data_set() + "#episode_0/observation.state"), 0, 4);
  write_info("v2.1", R"(["one name of two"])");
  EXPECT_THAT(read_recorded_table(data_set() + "#episode_0/observation.state").names,
              ElementsAre("joint_1", "joint_2"));
}

TEST_F(LeRobot, TablesOfOtherProgramsAreReadAsOne) {
  using Type = WrittenColumn::Type;
  const fs::path file =
      write("joints.parquet", test::parquet_bytes({{"time_ms", Type::kInt64, 0, {0, 100, 200}},
                                                   {"pan", Type::kDouble, 0, {0.5, {}, 1.5}},
                                                   {"note", Type::kText, 0, {0, 0, 0}},
                                                   {"tilt", Type::kFloat, 0, {0.25, 0.5, 0.75}}}));
  const RecordedTable table = read_recorded_table(file);
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.5, 0.25}, {1.5, 0.75}}));
  EXPECT_NEAR(table.times[1], 0.2, 1e-9);
  EXPECT_THAT(table.warnings, ElementsAre(HasSubstr("1 row left out, as a value")));
}

TEST_F(LeRobot, PagesOfBothVersionsAndAllCodecsHaveTheSameNumbers) {
  std::vector<WrittenColumn> columns = columns_of_frames({{0, 20}});
  columns[1].values[3] = std::nullopt;                         // an element
  columns[1].values[8] = columns[1].values[9] = std::nullopt;  // a list
  write_info("v2.0", "null");
  for (const int version : {1, 2}) {
    for (const int codec : {0, 1, 6}) {
      SCOPED_TRACE(fmt::format("version {}, codec {}", version, codec));
      for (WrittenColumn& column : columns) {
        column.has_dictionary = codec == 1 && column.type != WrittenColumn::Type::kBool;
      }
      const fs::path file = write("data/chunk-000/episode_000000.parquet",
                                  test::parquet_bytes(columns, {version, codec, 0, 7}));
      const RecordedTable states =
          read_recorded_table(file.string() + "#episode_0/observation.state");
      ASSERT_EQ(states.values.rows(), 20);
      EXPECT_EQ(states.values(19, 1), state_of(0, 19, 1));
      const RecordedTable actions = read_recorded_table(file.string() + "#episode_0/action");
      EXPECT_EQ(actions.values.rows(), 18);
      EXPECT_THAT(actions.warnings, testing::Contains(HasSubstr("2 rows left out, as a value")));
    }
  }
}

// These files were written by the Arrow libraries for Rust and by DuckDB.
TEST_F(LeRobot, FilesOfOtherWritersAreRead) {
  const fs::path folder = test::source_dir() / "tests/fuzz/corpora/recorded_lerobot";
  for (const char* name : {"arrow_fixed_lists_snappy", "arrow_lists_zstd", "duckdb_uncompressed"}) {
    SCOPED_TRACE(name);
    const fs::path file = write(std::string(name) + ".parquet", content_of_file(folder / name));
    const RecordedTable table = read_recorded_table(file.string() + "#episode_1/observation.state");
    ASSERT_EQ(table.values.rows(), 12);
    ASSERT_EQ(table.values.cols(), 3);
    for (int row = 0; row < 12; ++row) {
      EXPECT_EQ(table.values(row, 0), 0.25 * row);
      EXPECT_EQ(table.values(row, 1), row % 3);
      EXPECT_EQ(table.values(row, 2), -row);
      EXPECT_NEAR(table.times[row], row / 30.0, 1e-6);
    }
  }
}

TEST_F(LeRobot, OtherCodecsAndEncodingsAreRefusedByTheNameOfTheColumn) {
  const std::vector<WrittenColumn> columns{{"pan", WrittenColumn::Type::kDouble, 0, {1.0, 2.0}},
                                           {"tilt", WrittenColumn::Type::kDouble, 0, {1.0, 2.0}}};
  const fs::path file = write("a.parquet", test::parquet_bytes(columns, {1, 2}));
  EXPECT_EQ(refusal_of_table(file),
            file.string() +
                ": column pan: found pages compressed by GZIP, expected UNCOMPRESSED, SNAPPY or "
                "ZSTD. Write it again by pandas: to_parquet(FILE, compression=\"snappy\").");
  write("a.parquet", test::parquet_bytes(columns, {1, 0, 5}));
  EXPECT_THAT(refusal_of_table(file),
              AllOf(HasSubstr("column pan"), HasSubstr("DELTA_BINARY_PACKED"),
                    HasSubstr("RLE_DICTIONARY")));
}

TEST_F(LeRobot, FilesThatAreNotParquetAreRefused) {
  for (const std::string& bytes :
       {std::string(), std::string("PAR1"), std::string("PAR1PAR1"), std::string(100, 'x'),
        "PAR1" + std::string(100, 'x'), "PAR1" + std::string("\xFF\xFF\xFF\x7FPAR1"),
        std::string("PARE") + std::string(20, 'x') + "PARE"}) {
    const fs::path file = write("a.parquet", bytes);
    EXPECT_THAT(refusal_of_table(file), AllOf(HasSubstr(file.string()), HasSubstr("Parquet file")))
        << bytes;
  }
}

TEST_F(LeRobot, DamagedDataSetsAreRefusedWithFileAndElement) {
  write_version_2();
  write("meta/info.json", "{\"codebase_version\": \"v2.1\"}");
  EXPECT_THAT(refusal_of_table(data_set()), AllOf(HasSubstr("info.json"), HasSubstr("features")));
  write("meta/info.json", with(with(kInfo, "VERSION", "v2.1"), "[2]", "[\"x\"]"));
  EXPECT_THAT(refusal_of_table(data_set()), HasSubstr("info.json"));
  write_version_2();
  write("meta/episodes.jsonl", "{\"episode_index\": 0, \"length\": 4}\n{\"length\": 3}\n");
  EXPECT_THAT(refusal_of_table(data_set()), HasSubstr("episodes.jsonl:2: episode_index"));
  fs::remove_all(folder_.path() / "data");
  EXPECT_THAT(refusal_of_table(data_set()), HasSubstr("data/chunk-000"));
}

TEST_F(LeRobot, ListsOfDifferentLengthsAreNamed) {
  using Type = WrittenColumn::Type;
  std::vector<WrittenColumn> columns{{"episode_index", Type::kInt64, 0, {0, 0, 0}},
                                     {"q", Type::kDouble, 2, {1, 2, {}, {}, 5, 6}}};
  const fs::path file = write("a.parquet", test::parquet_bytes(columns));
  EXPECT_EQ(recording_contents(file).variables.at(0).problem, "lists of different lengths");
}

TEST_F(LeRobot, NamesThatAreNotUtf8AreShownAsText) {
  const fs::path file =
      write("a.parquet",
            test::parquet_bytes({{"pan\xFF", WrittenColumn::Type::kDouble, 0, {1.0, 2.0}},
                                 {"t\x1Bilt", WrittenColumn::Type::kDouble, 0, {1.0, 2.0}}}));
  EXPECT_THAT(read_recorded_table(file).names, ElementsAre("pan\\ufffd", "t\\u001bilt"));
}

TEST_F(LeRobot, AnyDamageIsSurvived) {
  const std::string valid = test::parquet_bytes(columns_of_frames({{0, 3}, {1, 2}}), {2, 1, 0, 4});
  test::for_damaged_copies(valid, [&](const std::string& bytes) {
    const fs::path file = write("d.parquet", bytes);
    static_cast<void>(test::refusal_of([&] {
      static_cast<void>(recording_contents(file));
      static_cast<void>(read_recorded_table(file));
    }));
  });
}

}  // namespace
}  // namespace handway::device
