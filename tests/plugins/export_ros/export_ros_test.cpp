// The field names and nesting are those of trajectory_msgs/JointTrajectory,
// moveit_msgs/DisplayTrajectory and what they are made of.
#include "handway_test/motions.h"
#include "ros_exporter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace handway::export_ros {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::map<std::string, std::string> contents(const planning::Exporter& exporter,
                                            const planning::Motion& motion) {
  std::map<std::string, std::string> all;
  for (const planning::ExportedFile& file : exporter.files(motion)) {
    all[file.name.string()] = file.content;
  }
  return all;
}

std::vector<std::string> keys(const YAML::Node& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) {
    names.push_back(entry.first.as<std::string>());
  }
  return names;
}

void expect_trajectory(const YAML::Node& message, const planning::Motion& motion, const char* sec,
                       const char* nanosec) {
  EXPECT_THAT(keys(message), ElementsAre("header", "joint_names", "points"));
  const auto names = message["joint_names"].as<std::vector<std::string>>();
  ASSERT_THAT(names, SizeIs(19));
  ASSERT_EQ(message["points"].size(), motion.trajectory.points.size());
  std::int64_t last = -1;
  for (std::size_t i = 0; i < motion.trajectory.points.size(); ++i) {
    const YAML::Node point = message["points"][i];
    const planning::TrajectoryPoint& expected = motion.trajectory.points[i];
    ASSERT_THAT(keys(point), ElementsAre("positions", "velocities", "accelerations", "effort",
                                         "time_from_start"));
    const auto positions = point["positions"].as<std::vector<double>>();
    const auto velocities = point["velocities"].as<std::vector<double>>();
    const auto accelerations = point["accelerations"].as<std::vector<double>>();
    ASSERT_THAT(positions, SizeIs(19));
    ASSERT_THAT(velocities, SizeIs(19));
    ASSERT_THAT(accelerations, SizeIs(19));
    ASSERT_EQ(point["effort"].size(), 0U);
    for (std::size_t j = 0; j < names.size(); ++j) {
      const int v = motion.model->find_variable(names[j]).value();
      ASSERT_EQ(positions[j], expected.position[v]) << "to the bit";
      ASSERT_EQ(velocities[j], expected.velocity[v]);
      ASSERT_EQ(accelerations[j], expected.acceleration[v]);
    }
    const YAML::Node time = point["time_from_start"];
    ASSERT_THAT(keys(time), ElementsAre(sec, nanosec));
    const auto parts = time[nanosec].as<std::int64_t>();
    ASSERT_LT(parts, 1'000'000'000);
    const std::int64_t now = time[sec].as<std::int64_t>() * 1'000'000'000 + parts;
    ASSERT_GT(now, last);
    ASSERT_NEAR(static_cast<double>(now), 1e9 * expected.time, 1.0);
    last = now;
  }
}

TEST(RosExporter, WritesJointTrajectoriesOfBothVersions) {
  const planning::Motion motion = test::tx90_sah_motion();
  const auto files = contents(RosExporter(), motion);
  ASSERT_THAT(files, SizeIs(4));
  expect_trajectory(YAML::Load(files.at("wave_ros1.yaml")), motion, "secs", "nsecs");
  expect_trajectory(YAML::Load(files.at("wave_ros2.yaml")), motion, "sec", "nanosec");
  // JSON is YAML, too; and is read by a JSON reader first.
  EXPECT_TRUE(nlohmann::json::accept(files.at("wave_ros1.json")));
  EXPECT_TRUE(nlohmann::json::accept(files.at("wave_ros2.json")));
  expect_trajectory(YAML::Load(files.at("wave_ros1.json")), motion, "secs", "nsecs");
  expect_trajectory(YAML::Load(files.at("wave_ros2.json")), motion, "sec", "nanosec");
}

TEST(RosExporter, GivesHeadersTheirVersionsFields) {
  const auto files = contents(RosExporter(), test::tx90_sah_motion());
  EXPECT_THAT(keys(YAML::Load(files.at("wave_ros1.yaml"))["header"]),
              ElementsAre("seq", "stamp", "frame_id"));
  EXPECT_THAT(keys(YAML::Load(files.at("wave_ros2.yaml"))["header"]),
              ElementsAre("stamp", "frame_id"));
}

TEST(MoveItExporter, WritesDisplayTrajectories) {
  const planning::Motion motion = test::tx90_sah_motion();
  const auto files = contents(MoveItExporter(), motion);
  ASSERT_THAT(files, SizeIs(2));
  for (const bool first : {true, false}) {
    const YAML::Node message =
        YAML::Load(files.at(first ? "wave_display_ros1.yaml" : "wave_display_ros2.yaml"));
    EXPECT_THAT(keys(message), ElementsAre("model_id", "trajectory", "trajectory_start"));
    EXPECT_EQ(message["model_id"].as<std::string>(), motion.model->name());
    ASSERT_EQ(message["trajectory"].size(), 1U);
    const YAML::Node robot = message["trajectory"][0];
    EXPECT_THAT(keys(robot), ElementsAre("joint_trajectory", "multi_dof_joint_trajectory"));
    expect_trajectory(robot["joint_trajectory"], motion, first ? "secs" : "sec",
                      first ? "nsecs" : "nanosec");
    EXPECT_THAT(keys(robot["multi_dof_joint_trajectory"]),
                ElementsAre("header", "joint_names", "points"));
    const YAML::Node start = message["trajectory_start"];
    EXPECT_THAT(keys(start), ElementsAre("joint_state", "multi_dof_joint_state",
                                         "attached_collision_objects", "is_diff"));
    EXPECT_FALSE(start["is_diff"].as<bool>());
    const auto names = start["joint_state"]["name"].as<std::vector<std::string>>();
    const auto positions = start["joint_state"]["position"].as<std::vector<double>>();
    const auto values =
        geometric::joint_values(*motion.model, motion.trajectory.points.front().position);
    ASSERT_THAT(names, SizeIs(23)) << "coupled joints, too";
    ASSERT_EQ(positions.size(), names.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(names[i], values[i].joint);
      EXPECT_EQ(positions[i], values[i].value);
    }
  }
}

TEST(RosExporter, WritesOutputsAndRestsAmongTheStages) {
  const planning::Motion motion = test::with_outputs_and_wait(
      test::with_stages(test::tx90_sah_motion(false)), {{"lamp", true}}, 2.5);
  const auto files = contents(RosExporter(), motion);
  const YAML::Node sequence = YAML::Load(files.at("wave_stages_ros2.yaml"));
  ASSERT_EQ(sequence.size(), 5U);
  EXPECT_THAT(keys(sequence[3]), ElementsAre("stage", "step", "output"));
  EXPECT_EQ(sequence[3]["output"]["name"].as<std::string>(), "lamp");
  EXPECT_TRUE(sequence[3]["output"]["value"].as<bool>());
  const YAML::Node rest = sequence[4]["trajectory"]["points"];
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_EQ(rest[1]["time_from_start"]["sec"].as<int>(), 2);
  EXPECT_EQ(rest[1]["positions"][3].as<double>(), rest[0]["positions"][3].as<double>());
  EXPECT_THAT(RosExporter().warnings(motion), SizeIs(1));
}

TEST(RosExporter, WritesTheStagesOneAfterAnother) {
  const planning::Motion motion = test::with_stages(test::tx90_sah_motion(false));
  const auto files = contents(RosExporter(), motion);
  ASSERT_THAT(files, SizeIs(8));
  expect_trajectory(YAML::Load(files.at("wave_ros2.yaml")), motion, "sec", "nanosec");
  const YAML::Node sequence = YAML::Load(files.at("wave_stages_ros2.yaml"));
  EXPECT_EQ(nlohmann::json::parse(files.at("wave_stages_ros1.json")).size(), 3U);
  ASSERT_EQ(sequence.size(), 3U);
  std::size_t points = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_THAT(keys(sequence[i]), ElementsAre("stage", "step", "trajectory"));
    EXPECT_EQ(sequence[i]["stage"].as<std::string>(), motion.stages[i].name);
    const YAML::Node all = sequence[i]["trajectory"]["points"];
    const YAML::Node first = all[0];
    const YAML::Node last = all[all.size() - 1];
    EXPECT_EQ(first["time_from_start"]["nanosec"].as<int>(), 0) << "each begins at 0";
    for (const int v : {0, 3}) {
      EXPECT_EQ(first["positions"][v].as<double>(), motion.path.waypoints[i][v]);
      EXPECT_EQ(last["positions"][v].as<double>(), motion.path.waypoints[i + 1][v]);
      EXPECT_NEAR(last["velocities"][v].as<double>(), 0.0, 1e-9);
    }
    points += all.size();
  }
  EXPECT_EQ(points, motion.trajectory.points.size() + 2) << "borders are of both stages";
}

}  // namespace
}  // namespace handway::export_ros
