#include "messages.h"

#include <cmath>
#include <cstdint>

namespace handway::export_ros {
namespace {

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

}  // namespace

Message header(RosVersion version) {
  Message message;
  if (version == RosVersion::kRos1) {
    message["seq"] = 0;
  }
  message["stamp"] = time_message(0.0, version);
  message["frame_id"] = "";
  return message;
}

Message joint_trajectory(const planning::Motion& motion, RosVersion version) {
  Message names = Message::array();
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    names.push_back(motion.model->variable(v).name);
  }
  Message points = Message::array();
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    points.push_back({{"positions", numbers(point.position)},
                      {"velocities", numbers(point.velocity)},
                      {"accelerations", numbers(point.acceleration)},
                      {"effort", Message::array()},
                      {"time_from_start", time_message(point.time, version)}});
  }
  return {{"header", header(version)}, {"joint_names", names}, {"points", points}};
}

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

}  // namespace handway::export_ros
