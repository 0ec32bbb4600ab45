#include "csv_exporter.h"
#include "handway/planning/paths/path_file.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace handway::export_csv {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::SizeIs;

using Columns = std::map<std::string, std::vector<double>>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    found.push_back(cell);
  }
  return found;
}

Columns read(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells(line);
  Columns columns;
  while (std::getline(lines, line)) {
    const std::vector<std::string> row = cells(line);
    EXPECT_EQ(row.size(), names.size());
    for (std::size_t c = 0; c < names.size(); ++c) {
      columns[names[c]].push_back(std::stod(row[c]));
    }
  }
  return columns;
}

TEST(CsvExporter, WritesWhatReadsBackToTheSameBits) {
  const planning::Motion motion = test::tx90_sah_motion();
  const auto files = CsvExporter().files(motion);
  ASSERT_THAT(files, SizeIs(1));
  const Columns columns = read(files[0].content);
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    const std::string& joint = motion.model->variable(v).name;
    for (std::size_t i = 0; i < motion.trajectory.points.size(); ++i) {
      const planning::TrajectoryPoint& point = motion.trajectory.points[i];
      ASSERT_NEAR(columns.at("time")[i], point.time, 0.6e-9);
      ASSERT_EQ(columns.at(joint)[i], point.position[v]);
      ASSERT_EQ(columns.at(joint + ".velocity")[i], point.velocity[v]);
      ASSERT_EQ(columns.at(joint + ".acceleration")[i], point.acceleration[v]);
    }
  }
  EXPECT_EQ(columns.at("Index-Dist"), columns.at("Index-Med")) << "coupled";
}

TEST(CsvExporter, WritesTimesInAsFewDigitsAsNanosecondsTake) {
  planning::Motion motion = test::tx90_sah_motion();
  const double step = 0.004;
  for (std::size_t i = 0; i < motion.trajectory.points.size(); ++i) {
    motion.trajectory.points[i].time = static_cast<double>(i) * step;
  }
  ASSERT_NE(9 * step, 0.036) << "a product that is longer than what is meant";
  const std::string text = CsvExporter().files(motion)[0].content;
  EXPECT_THAT(text, HasSubstr("\n0.036,"));
  EXPECT_THAT(text, Not(HasSubstr("\n0.0360")));
  EXPECT_THAT(SplitExporter().files(motion)[1].content, HasSubstr("\n0.036,"));
}

TEST(CsvExporter, WritesAPath) {
  const test::ScratchFolder scratch;
  const planning::Motion motion = test::tx90_sah_motion();
  const auto written = CsvExporter().write(motion, scratch.path());
  const planning::Path path = planning::read_path(*motion.model, written.at(0));
  ASSERT_EQ(path.waypoints.size(), motion.trajectory.points.size());
  EXPECT_EQ(path.waypoints[7], motion.trajectory.points[7].position);
}

TEST(SplitExporter, PartsArmAndHandAtTheSameTimes) {
  const planning::Motion motion = test::tx90_sah_motion();
  const auto files = SplitExporter().files(motion);
  ASSERT_THAT(files, SizeIs(2));
  EXPECT_EQ(files[0].name, "wave_arm.csv");
  EXPECT_EQ(files[1].name, "wave_hand.csv");
  const Columns arm = read(files[0].content);
  const Columns hand = read(files[1].content);
  EXPECT_THAT(arm, SizeIs(1 + 2 * 6));
  EXPECT_THAT(hand, SizeIs(1 + 2 * 13)) << "the independent joints of the SAH";
  EXPECT_THAT(hand, Not(Contains(Key("Index-Dist"))));
  EXPECT_EQ(arm.at("time"), hand.at("time"));
  for (std::size_t i = 0; i < motion.trajectory.points.size(); ++i) {
    for (const auto& [columns, variables] :
         {std::pair(&arm, &motion.arm), std::pair(&hand, &motion.hand)}) {
      for (const int v : *variables) {
        const std::string& joint = motion.model->variable(v).name;
        ASSERT_EQ(columns->at(joint)[i], motion.trajectory.points[i].position[v]);
        ASSERT_EQ(columns->at(joint + ".velocity")[i], motion.trajectory.points[i].velocity[v]);
      }
    }
  }
}

TEST(SplitExporter, NeedsAnArmAndAHand) {
  planning::Motion motion = test::tx90_sah_motion();
  motion.hand.clear();
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(SplitExporter().files(motion)); }),
              HasSubstr("no hand"));
}

TEST(CsvExporter, HasTheStageOfEachRow) {
  const planning::Motion motion = test::with_stages(test::tx90_sah_motion(false));
  std::vector<planning::ExportedFile> files = CsvExporter().files(motion);
  for (const planning::ExportedFile& file : SplitExporter().files(motion)) {
    files.push_back(file);
  }
  ASSERT_THAT(files, SizeIs(3));
  for (const planning::ExportedFile& file : files) {
    std::istringstream lines(file.content);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(cells(line).back(), "stage");
    const std::size_t columns = cells(line).size();
    for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
      std::getline(lines, line);
      ASSERT_EQ(cells(line).size(), columns);
      const double time = point.time - 1e-9;
      ASSERT_EQ(cells(line).back(), time < motion.waypoint_times[1]   ? "approach"
                                    : time < motion.waypoint_times[2] ? "close"
                                                                      : "lift")
          << point.time;
    }
  }
}

TEST(CsvExporter, StandsStillWhileAProgramWaits) {
  const planning::Motion motion = test::with_outputs_and_wait(
      test::with_stages(test::tx90_sah_motion(false)), {{"lamp", true}}, 2.5);
  const std::string text = CsvExporter().files(motion)[0].content;
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_EQ(cells(last.substr(0, last.size() - 1)).back(), "wait");
  EXPECT_NEAR(std::stod(last), motion.waypoint_times.back(), 1e-9);
  EXPECT_EQ(CsvExporter().warnings(motion),
            std::vector<std::string>{
                "csv does not set the output lamp to true: the format has no outputs."});
}

TEST(CsvExporter, WritesAPathFileOfAMotionWithStages) {
  const planning::Motion motion = test::with_stages(test::tx90_sah_motion(false));
  const test::ScratchFolder scratch;
  const auto written = CsvExporter().write(motion, scratch.path());
  const planning::Path path = planning::read_path(*motion.model, written[0]);
  ASSERT_EQ(path.waypoints.size(), motion.trajectory.points.size());
  EXPECT_EQ(path.waypoints.back(), motion.path.waypoints.back());
}

}  // namespace
}  // namespace handway::export_csv
