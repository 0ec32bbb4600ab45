#include "franka_exporter.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace handway::export_franka {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

planning::Motion motion() {
  planning::TimingOptions options;
  options.period = FrankaExporter().point_period();
  return test::panda_motion(options);
}

/// The rows of a table with a header, as numbers.
std::vector<std::vector<double>> rows(const std::string& text, std::string& header) {
  std::istringstream lines(text);
  std::getline(lines, header);
  std::vector<std::vector<double>> all;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) {
      row.push_back(std::stod(cell));
    }
    all.push_back(std::move(row));
  }
  return all;
}

TEST(FrankaExporter, WritesAPointEveryMillisecond) {
  const planning::Motion original = motion();
  const auto files = FrankaExporter().files(original);
  ASSERT_THAT(files, SizeIs(2));
  EXPECT_EQ(files[0].name, "wave_franka.csv");
  std::string header;
  const auto table = rows(files[0].content, header);
  EXPECT_EQ(header, "time,q1,q2,q3,q4,q5,q6,q7,dq1,dq2,dq3,dq4,dq5,dq6,dq7");
  const auto& points = original.trajectory.points;
  ASSERT_EQ(table.size(), points.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    ASSERT_THAT(table[i], SizeIs(15));
    ASSERT_NEAR(table[i][0], 1e-3 * static_cast<double>(i), 1e-9);
    for (std::size_t j = 0; j < 7; ++j) {
      ASSERT_EQ(table[i][1 + j], points[i].position[original.arm[j]]) << "to the bit";
      ASSERT_EQ(table[i][8 + j], points[i].velocity[original.arm[j]]);
    }
  }
}

TEST(FrankaExporter, WritesTheSameAsJsonWithTheLimits) {
  planning::Motion original = motion();
  original.stages = {{.name = "move", .step = "move to \"home\"\n"}};
  const auto files = FrankaExporter().files(original);
  const auto read = nlohmann::json::parse(files[1].content);
  EXPECT_EQ(files[1].name, "wave_franka.json");
  EXPECT_EQ(read["period_s"], 0.001);
  EXPECT_EQ(read["joint_names"].size(), 7U);
  EXPECT_EQ(read["limits"]["robot"], "the Franka Emika Robot");
  EXPECT_EQ(read["limits"]["velocity"][6], 2.61);
  EXPECT_EQ(read["stages"][0]["step"], "move to \"home\"\n");
  ASSERT_EQ(read["q"].size(), original.trajectory.points.size());
  EXPECT_EQ(read["q"].back()[3].get<double>(),
            original.trajectory.points.back().position[original.arm[3]]);
  EXPECT_EQ(read["dq"].back(), (std::vector<double>(7, 0.0)));
}

TEST(FrankaExporter, RepeatsThePointWhileAProgramWaits) {
  planning::Motion original = motion();
  original.stages = {{.name = "move", .step = "move to home"}};
  const planning::Motion waiting =
      test::with_outputs_and_wait(original, {{"lamp", true}, {"level", 0.5}}, 0.25);
  const auto files = FrankaExporter().files(waiting);
  std::string header;
  const auto table = rows(files[0].content, header);
  ASSERT_EQ(table.size(), original.trajectory.points.size() + 250);
  EXPECT_NEAR(table.back()[0] - table[table.size() - 2][0], 1e-3, 1e-9);
  EXPECT_EQ(table.back()[1], table[table.size() - 250][1]);
  const auto stages = nlohmann::json::parse(files[1].content)["stages"];
  EXPECT_EQ(stages[1]["output"]["name"], "lamp");
  EXPECT_EQ(stages[1]["output"]["value"], true);
  EXPECT_EQ(stages[2]["output"]["value"], 0.5);
  EXPECT_THAT(FrankaExporter().warnings(waiting), SizeIs(2));
}

TEST(FrankaExporter, KnowsTheLimitsOfBothRobots) {
  EXPECT_STREQ(franka_limits(motion()).robot, "the Franka Emika Robot");
  EXPECT_STREQ(franka_limits(test::with_robot_name(motion(), "fr3_cell")).robot,
               "Franka Research 3");
}

TEST(FrankaExporter, RefusesMotionsThatTheInterfaceWouldStop) {
  const auto refusal = [](const planning::Motion& bad) {
    return test::refusal_of([&] { static_cast<void>(FrankaExporter().files(bad)); });
  };
  planning::Motion research = test::with_robot_name(motion(), "fr3");
  EXPECT_NO_THROW(static_cast<void>(FrankaExporter().files(research)));
  planning::Motion jump = motion();
  const std::size_t middle = jump.trajectory.points.size() / 4;
  jump.trajectory.points[middle].position[jump.arm[1]] += 1e-5;
  EXPECT_THAT(refusal(jump), AllOf(HasSubstr("joint_2"), HasSubstr("acceleration")));
  planning::Motion rough = motion();
  rough.trajectory.points[middle].position[rough.arm[1]] += 2e-6;
  EXPECT_THAT(refusal(rough), AllOf(HasSubstr("joint_2 at 0."), HasSubstr("jerk"),
                                    HasSubstr("3750 rad/s³"), HasSubstr("--jerk")));
}

TEST(FrankaExporter, RefusesOtherArms) {
  planning::TimingOptions options;
  options.period = 0.001;
  const planning::Motion six = test::tx90_sah_motion(options);
  const auto refusal = [&](const planning::ExportOptions& chosen) {
    return test::refusal_of([&] { static_cast<void>(FrankaExporter().files(six, chosen)); });
  };
  EXPECT_THAT(refusal({}), AllOf(HasSubstr("Franka"), HasSubstr("--any-robot")));
  EXPECT_THAT(refusal({.any_robot = true}), AllOf(HasSubstr("6 joints"), HasSubstr("seven")));
  for (const char* robot : {"panda", "FR3", "franka_emika", "fer"}) {
    EXPECT_THAT(FrankaExporter().robot_objection(test::with_robot_name(six, robot)), IsEmpty());
  }
}

}  // namespace
}  // namespace handway::export_franka
