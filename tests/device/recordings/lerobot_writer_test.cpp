#include "handway/device/recordings/lerobot_writer.h"

#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kFps = 50;

/// A motion of two joints and an object.
RecordedTable episode_of(int number, Eigen::Index rows) {
  RecordedTable table;
  table.names = {"pan", "tilt", "can.x", "stage"};
  table.times = Eigen::VectorXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1) / kFps);
  table.values.resize(rows, 4);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto at = static_cast<double>(row);
    table.values.row(row) << number + 0.125 * at, -0.5 * at, 0.25, row < 2 ? 0 : 1;
  }
  return table;
}

class WrittenLeRobot : public testing::Test {
 protected:
  static LeRobotLayout layout() {
    return {"arm",
            kFps,
            {"pan", "tilt"},
            {{"observation.environment_state", {"can.x"}, false}, {"stage", {"stage"}, true}}};
  }
  void write(const std::vector<Eigen::Index>& lengths) const {
    LeRobotWriter writer(folder_.path(), layout());
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      writer.add(episode_of(static_cast<int>(i), lengths[i]), i % 2 == 0 ? "pick" : "place",
                 "episode");
    }
    writer.finish();
  }
  [[nodiscard]] nlohmann::json json(const char* name) const {
    std::ifstream stream(folder_.path() / "meta" / name);
    return nlohmann::json::parse(stream);
  }
  [[nodiscard]] RecordedTable read(const std::string& variable) const {
    return read_recorded_table(folder_.path().string() + "#" + variable);
  }

  test::ScratchFolder folder_;
};

TEST_F(WrittenLeRobot, IsReadAgain) {
  write({4, 3, 5});
  EXPECT_EQ(recording_contents(folder_.path()).kind.name, "LeRobot");
  for (int number = 0; number < 3; ++number) {
    SCOPED_TRACE(number);
    const RecordedTable written = episode_of(number, number == 0 ? 4 : number == 1 ? 3 : 5);
    const RecordedTable state = read(fmt::format("episode_{}/observation.state", number));
    EXPECT_THAT(state.names, ElementsAre("pan", "tilt"));
    EXPECT_EQ(state.values, written.values.leftCols(2));
    EXPECT_TRUE(state.times.isApprox(written.times, 1e-6));
    const RecordedTable action = read(fmt::format("episode_{}/action", number));
    const Eigen::Index rows = written.values.rows();
    EXPECT_EQ(action.values.topRows(rows - 1), written.values.leftCols(2).bottomRows(rows - 1));
    EXPECT_EQ(action.values.row(rows - 1), written.values.row(rows - 1).head(2));
    EXPECT_EQ(read(fmt::format("episode_{}/stage", number)).values, written.values.col(3));
  }
  EXPECT_EQ(read("observation.state").values.rows(), 12);
}

TEST_F(WrittenLeRobot, NamesItsFeaturesAndCounts) {
  write({4, 3, 5});
  const nlohmann::json info = json("info.json");
  EXPECT_EQ(info["codebase_version"], "v3.0");
  EXPECT_EQ(info["fps"], kFps);
  EXPECT_EQ(info["total_episodes"], 3);
  EXPECT_EQ(info["total_frames"], 12);
  EXPECT_EQ(info["total_tasks"], 2);
  EXPECT_EQ(info["splits"]["train"], "0:3");
  EXPECT_EQ(info["features"]["observation.state"]["shape"], nlohmann::json::array({2}));
  EXPECT_EQ(info["features"]["action"]["names"], nlohmann::json::array({"pan", "tilt"}));
  EXPECT_EQ(info["features"]["stage"]["dtype"], "int64");
  EXPECT_TRUE(info["features"]["timestamp"]["names"].is_null());
  const nlohmann::json stats = json("stats.json");
  EXPECT_EQ(stats["observation.state"]["count"], nlohmann::json::array({12}));
  EXPECT_EQ(stats["observation.state"]["min"], nlohmann::json::array({0.0, -2.0}));
  EXPECT_EQ(stats["observation.state"]["max"], nlohmann::json::array({2.5, 0.0}));
  // Frames 0 to 3, 0 to 2 and 0 to 4: mean 19/12, mean square 49/12.
  EXPECT_NEAR(stats["frame_index"]["mean"][0].get<double>(), 19.0 / 12.0, 1e-12);
  EXPECT_NEAR(stats["frame_index"]["std"][0].get<double>(),
              std::sqrt(49.0 / 12.0 - 19.0 * 19.0 / 144.0), 1e-12);
  EXPECT_EQ(stats["index"]["max"], nlohmann::json::array({11.0}));
  EXPECT_TRUE(fs::exists(folder_.path() / "meta" / "tasks.parquet"));
}

TEST_F(WrittenLeRobot, ListsMoreEpisodesThanAGroupHas) {
  write(std::vector<Eigen::Index>(130, 2));
  EXPECT_EQ(read("episode_129/observation.state").values, episode_of(129, 2).values.leftCols(2));
  EXPECT_EQ(read("observation.state").values.rows(), 260);
}

TEST_F(WrittenLeRobot, ReplacesAnEarlierOne) {
  write({4, 3, 5});
  const fs::path stray = folder_.path() / "data" / "chunk-000" / "file-001.parquet";
  fs::copy_file(folder_.path() / "data" / "chunk-000" / "file-000.parquet", stray);
  write({2});
  EXPECT_FALSE(fs::exists(stray));
  EXPECT_EQ(read("episode_0/observation.state").values.rows(), 2);
}

TEST_F(WrittenLeRobot, RefusesOtherTimesAndColumns) {
  LeRobotWriter writer(folder_.path(), layout());
  RecordedTable late = episode_of(0, 3);
  late.times[2] += 0.01;
  EXPECT_THAT(test::refusal_of([&] { writer.add(late, "pick", "a.npz"); }),
              testing::AllOf(HasSubstr("a.npz"), HasSubstr("50 frames per second")));
  RecordedTable other = episode_of(0, 3);
  other.names[1] = "roll";
  EXPECT_THAT(test::refusal_of([&] { writer.add(other, "pick", "a.npz"); }),
              HasSubstr("no column tilt"));
}

}  // namespace
}  // namespace handway::device
