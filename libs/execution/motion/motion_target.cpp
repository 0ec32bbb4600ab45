#include "handway/execution/motion/motion_target.h"

#include "handway/device/arm/val3_arm.h"
#include "handway/device/core/byte_link.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <variant>

namespace handway::execution {
namespace {

/// Address of a device in the option `--to`.
struct MotionAddress {
  std::string text;  ///< Address as the user wrote it.
  std::string part;  ///< Part of the robot: "arm", "hand" or kWholeRobot.
  /// TCP address of a VAL3 server or a hand, or address of a robot in ROS.
  std::variant<device::TcpAddress, device::RosAddress> where;
};

constexpr const char* kScheme = "://";
constexpr const char* kDefaultController = "/joint_trajectory_controller";

[[noreturn]] void refuse(const std::string& found) {
  throw geometric::InputError(
      {"--to", "", fmt::format("\"{}\"", found),
       "arm://HOST[:PORT], hand://HOST[:PORT], both separated by a comma, or "
       "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]",
       "Write, for example, arm://localhost:11000."});
}

/// Cuts `text` at the first `mark`. @returns the part from the mark on; empty without a mark.
std::string cut_from(std::string& text, char mark) {
  const std::size_t at = std::min(text.find(mark), text.size());
  std::string tail = text.substr(at);
  text.resize(at);
  return tail;
}

MotionAddress ros_address(const std::string& text, std::string where, device::RosVersion version) {
  const std::string part = cut_from(where, '#');
  const std::string controller = cut_from(where, '/');
  if (where.empty() || (!part.empty() && part != "#arm" && part != "#hand")) {
    refuse(text);
  }
  const device::TcpAddress address = device::parse_host_and_port(where, device::kRosbridgePort);
  return {text, part.empty() ? kWholeRobot : part.substr(1),
          device::RosAddress{
              address.host, address.port, version,
              device::trajectory_topic(
                  controller.size() > 1 ? controller : std::string(kDefaultController), version)}};
}

/// Reads "arm://HOST[:PORT]", "hand://HOST[:PORT]", "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]" or
/// "ros2://" with the same parts.
/// @throws InputError for anything else.
MotionAddress parse_motion_address(const std::string& text) {
  const std::size_t at = text.find(kScheme);
  const std::string kind = text.substr(0, std::min(at, text.size()));
  const std::string where =
      at == std::string::npos ? "" : text.substr(at + std::string(kScheme).size());
  if (where.empty()) {
    refuse(text);
  }
  if (kind == "arm") {
    return {text, kind, device::parse_host_and_port(where, device::kVal3MotionPort)};
  }
  if (kind == "hand") {
    return {text, kind, device::parse_host_and_port(where, device::kHandPort)};
  }
  if (kind == "ros" || kind == "ros2") {
    return ros_address(text, where,
                       kind == "ros" ? device::RosVersion::kRos1 : device::RosVersion::kRos2);
  }
  refuse(text);
}

MotionTarget parse_target(const std::string& text, const planning::PlanningProblem& problem) {
  const MotionAddress address = parse_motion_address(text);
  MotionTarget target{address.part, problem.joints.of_part(address.part), nullptr};
  if (target.variables.empty()) {
    throw geometric::InputError(
        {"--to", "", text, "a device for a part of the robot",
         fmt::format("Robot \"{}\" has no {}.", problem.model().name(), address.part)});
  }
  device::JointRanges joints = device_joints(problem.model(), target.variables);
  if (const auto* ros = std::get_if<device::RosAddress>(&address.where)) {
    target.link = std::make_unique<device::RosRobot>(text, *ros, joints);
    return target;
  }
  const auto& [host, port] = std::get<device::TcpAddress>(address.where);
  if (address.part == "arm") {
    target.link = std::make_unique<device::Val3Arm>(text, host, port, joints);
  } else {
    target.link = std::make_unique<device::NetworkHand>(text, host, port, joints);
  }
  return target;
}

bool share_joints(const MotionTarget& one, const MotionTarget& other) {
  return std::ranges::any_of(one.variables, [&](int v) {
    return std::ranges::find(other.variables, v) != other.variables.end();
  });
}

}  // namespace

device::JointRanges device_joints(const geometric::RobotModel& model,
                                  const std::vector<int>& variables) {
  const auto count = static_cast<Eigen::Index>(variables.size());
  device::JointRanges joints{
      {}, Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const geometric::Joint& joint = model.variable(variables[static_cast<std::size_t>(j)]);
    if (!(joint.limits.velocity > 0.0 && std::isfinite(joint.limits.velocity))) {
      throw geometric::InputError({"robot " + model.name(), "joint " + joint.name,
                                   "no velocity limit", "the device's nominal velocity",
                                   "Add it to the robot's file."});
    }
    joints.names.push_back(joint.name);
    joints.lower[j] = joint.limits.lower;
    joints.upper[j] = joint.limits.upper;
    joints.velocity[j] = joint.limits.velocity;
  }
  return joints;
}

std::vector<MotionTarget> parse_targets(const std::string& text,
                                        const planning::PlanningProblem& problem) {
  std::vector<MotionTarget> targets;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    MotionTarget target = parse_target(part, problem);
    for (const MotionTarget& other : targets) {
      if (share_joints(target, other)) {
        throw geometric::InputError({"--to", "", fmt::format("two devices for the {}", target.kind),
                                     "one for each joint", "Remove one."});
      }
    }
    targets.push_back(std::move(target));
  }
  if (targets.empty()) {
    static_cast<void>(parse_motion_address(text));
  }
  // Arms come first: an arm can pause only at its points, so that its pause sets the others' time.
  std::stable_partition(targets.begin(), targets.end(),
                        [](const MotionTarget& target) { return target.kind == "arm"; });
  return targets;
}

namespace {

// Largest displacement of a joint at rest, rad or m.
constexpr double kStillSpeed = 1e-6;

}  // namespace

planning::Configuration with_measured(planning::Configuration q,
                                      const std::vector<MotionTarget>& targets) {
  for (const MotionTarget& target : targets) {
    const Eigen::VectorXd& position = target.link->measured().position;
    for (std::size_t j = 0; j < target.variables.size(); ++j) {
      q[target.variables[j]] = position[static_cast<Eigen::Index>(j)];
    }
  }
  return q;
}

void check_that_the_rest_stands(const geometric::RobotModel& model, const planning::Path& path,
                                const std::vector<MotionTarget>& targets) {
  const planning::Configuration& first = path.waypoints.front();
  std::vector<bool> driven(static_cast<std::size_t>(first.size()));
  std::string devices;
  for (const MotionTarget& target : targets) {
    devices += (devices.empty() ? "" : ",") + target.link->name();
    for (const int v : target.variables) {
      driven[static_cast<std::size_t>(v)] = true;
    }
  }
  for (const planning::Configuration& waypoint : path.waypoints) {
    for (Eigen::Index v = 0; v < first.size(); ++v) {
      if (!driven[static_cast<std::size_t>(v)] && std::abs(waypoint[v] - first[v]) > kStillSpeed) {
        throw geometric::InputError({"--to", "", devices,
                                     "devices for all joints that the path moves",
                                     fmt::format("No device moves joint \"{}\".",
                                                 model.variable(static_cast<int>(v)).name)});
      }
    }
  }
}

device::JointTrajectory part_of(const planning::Trajectory& trajectory,
                                const std::vector<int>& variables) {
  device::JointTrajectory part;
  part.positions.resize(static_cast<Eigen::Index>(trajectory.points.size()),
                        static_cast<Eigen::Index>(variables.size()));
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    const auto row = static_cast<Eigen::Index>(part.times.size());
    part.times.push_back(point.time - trajectory.points.front().time);
    for (std::size_t j = 0; j < variables.size(); ++j) {
      part.positions(row, static_cast<Eigen::Index>(j)) = point.position[variables[j]];
    }
  }
  return part;
}

}  // namespace handway::execution
