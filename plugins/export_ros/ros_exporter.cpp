#include "ros_exporter.h"

#include "handway/planning/extensions/exporter.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/timed_task.h"

#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::export_ros {
namespace {

using Message = nlohmann::ordered_json;

/// Version of ROS. It decides the names of the parts of a time, {secs, nsecs} or {sec, nanosec};
/// and only the first has `seq` in its headers.
enum class RosVersion { kRos1, kRos2 };

Message time_message(double seconds, RosVersion version) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  const auto all = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  const bool first = version == RosVersion::kRos1;
  return {{first ? "secs" : "sec", all / kNanoseconds},
          {first ? "nsecs" : "nanosec", all % kNanoseconds}};
}

Message numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

/// std_msgs/Header with time 0, which means "now".
Message header(RosVersion version) {
  Message message;
  if (version == RosVersion::kRos1) {
    message["seq"] = 0;
  }
  message["stamp"] = time_message(0.0, version);
  message["frame_id"] = "";
  return message;
}

/// Returns the trajectory_msgs/JointTrajectory of the independent joints: the effort arrays are
/// empty, times increase strictly.
/// @param points a part of the motion's, which begins at its first time.
Message joint_trajectory(const planning::Motion& motion,
                         std::span<const planning::TrajectoryPoint> points, RosVersion version) {
  Message names = Message::array();
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    names.push_back(motion.model->variable(v).name);
  }
  Message messages = Message::array();
  for (const planning::TrajectoryPoint& point : points) {
    messages.push_back(
        {{"positions", numbers(point.position)},
         {"velocities", numbers(point.velocity)},
         {"accelerations", numbers(point.acceleration)},
         {"effort", Message::array()},
         {"time_from_start", time_message(point.time - points.front().time, version)}});
  }
  return {{"header", header(version)}, {"joint_names", names}, {"points", messages}};
}

/// Returns the stages in their order: the name of each, and its trajectory_msgs/JointTrajectory, or
/// the output that it sets.
Message stage_sequence(const planning::Motion& motion, RosVersion version) {
  Message sequence = Message::array();
  for (std::size_t i = 0; i < motion.stages.size(); ++i) {
    Message stage = {{"stage", motion.stages[i].name}, {"step", motion.stages[i].step}};
    if (const auto& output = motion.stages[i].output) {
      stage["output"] = {{"name", output->name}};
      std::visit([&](auto value) { stage["output"]["value"] = value; }, output->value);
    } else {
      stage["trajectory"] = joint_trajectory(motion, points_of_stage(motion, i), version);
    }
    sequence.push_back(std::move(stage));
  }
  return sequence;
}

/// moveit_msgs/RobotState: the start of the motion, with the coupled joints.
Message start_state(const planning::Motion& motion, RosVersion version) {
  Message names = Message::array();
  Message positions = Message::array();
  for (const geometric::JointValue& joint :
       geometric::joint_values(*motion.model, motion.trajectory.points.front().position)) {
    names.push_back(std::string(joint.joint));
    positions.push_back(joint.value);
  }
  const Message none = Message::array();
  return {{"joint_state",
           {{"header", header(version)},
            {"name", names},
            {"position", positions},
            {"velocity", none},
            {"effort", none}}},
          {"multi_dof_joint_state",
           {{"header", header(version)},
            {"joint_names", none},
            {"transforms", none},
            {"twist", none},
            {"wrench", none}}},
          {"attached_collision_objects", none},
          {"is_diff", false}};
}

// NOLINTNEXTLINE(misc-no-recursion): messages are a few levels deep
void write_value(YAML::Emitter& out, const Message& message) {
  switch (message.type()) {
    case Message::value_t::object:
      out << YAML::BeginMap;
      for (const auto& [key, value] : message.items()) {
        out << YAML::Key << key << YAML::Value;
        write_value(out, value);
      }
      out << YAML::EndMap;
      return;
    case Message::value_t::array: {
      const bool plain =
          std::ranges::none_of(message, [](const Message& item) { return item.is_structured(); });
      out << (plain ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
      for (const Message& item : message) {
        write_value(out, item);
      }
      out << YAML::EndSeq;
      return;
    }
    case Message::value_t::string:
      out << YAML::DoubleQuoted << message.get<std::string>();
      return;
    case Message::value_t::boolean:
      out << message.get<bool>();
      return;
    case Message::value_t::number_float:
      out << message.get<double>();
      return;
    default:
      out << message.get<std::int64_t>();
  }
}

/// The message as YAML, with arrays of plain values on one line; numbers read back to the same
/// bits.
std::string to_yaml(const Message& message) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  write_value(out, message);
  return std::string(out.c_str()) + "\n";
}

}  // namespace

std::string RosExporter::output_objection(const geometric::OutputStep& /*output*/) const {
  return "only the files of the stages have it";
}

std::vector<planning::ExportedFile> RosExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& /*options*/) const {
  std::vector<planning::ExportedFile> files;
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    const std::string end = version == RosVersion::kRos1 ? "_ros1" : "_ros2";
    const Message message = joint_trajectory(motion, motion.trajectory.points, version);
    files.push_back({motion.name + end + ".yaml", to_yaml(message)});
    files.push_back({motion.name + end + ".json", message.dump() + "\n"});
    if (!motion.stages.empty()) {
      const Message sequence = stage_sequence(motion, version);
      files.push_back({motion.name + "_stages" + end + ".yaml", to_yaml(sequence)});
      files.push_back({motion.name + "_stages" + end + ".json", sequence.dump() + "\n"});
    }
  }
  return files;
}

std::vector<planning::ExportedFile> MoveItExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& /*options*/) const {
  std::vector<planning::ExportedFile> files;
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    const Message none = Message::array();
    const Message robot_trajectory = {
        {"joint_trajectory", joint_trajectory(motion, motion.trajectory.points, version)},
        {"multi_dof_joint_trajectory",
         {{"header", header(version)}, {"joint_names", none}, {"points", none}}}};
    const Message message = {{"model_id", motion.model->name()},
                             {"trajectory", Message::array({robot_trajectory})},
                             {"trajectory_start", start_state(motion, version)}};
    const char* end = version == RosVersion::kRos1 ? "_display_ros1.yaml" : "_display_ros2.yaml";
    files.push_back({motion.name + end, to_yaml(message)});
  }
  return files;
}

}  // namespace handway::export_ros

HANDWAY_PLUGIN({.name = "export_ros", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_ros::RosExporter>());
                  exporters.push_back(std::make_unique<handway::export_ros::MoveItExporter>());
                  return exporters;
                }});
