#include "handway/execution/motion/motion_target.h"

#include "handway/device/arm/val3_arm.h"
#include "handway/device/core/device_address.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

namespace handway::execution {
namespace {

constexpr const char* kScheme = "://";

[[noreturn]] void refuse(const std::string& found) {
  throw geometric::InputError({"--to", "", fmt::format("\"{}\"", found),
                               "arm://HOST[:PORT], hand://HOST[:PORT] or both with a comma between",
                               "Write, for example, arm://localhost:11000."});
}

device::TcpAddress parse_address(const std::string& text, std::uint16_t default_port) {
  const bool has_port =
      text.find(':', text.starts_with('[') ? text.find(']') : 0) != std::string::npos;
  return std::get<device::TcpAddress>(device::parse_device_address(
      has_port ? fmt::format("tcp://{}", text) : fmt::format("tcp://{}:{}", text, default_port)));
}

MotionTarget parse_target(const std::string& text, const planning::PlanningProblem& problem) {
  const std::size_t at = text.find(kScheme);
  const std::string kind = text.substr(0, std::min(at, text.size()));
  if (at == std::string::npos || (kind != "arm" && kind != "hand")) {
    refuse(text);
  }
  const std::string where = text.substr(at + std::string(kScheme).size());
  if (where.empty()) {
    refuse(text);
  }
  MotionTarget target{kind, device_variables(problem, kind), nullptr};
  if (target.variables.empty()) {
    throw geometric::InputError(
        {"--to", "", text, "a device that the robot has",
         fmt::format("Robot \"{}\" has no {}.", problem.model().name(), kind)});
  }
  device::JointRanges joints = device_joints(problem.model(), target.variables);
  if (kind == "arm") {
    const device::TcpAddress address = parse_address(where, device::kVal3MotionPort);
    target.link = std::make_unique<device::Val3Arm>(text, address.host, address.port, joints);
  } else {
    const device::TcpAddress address = parse_address(where, device::kHandPort);
    target.link = std::make_unique<device::NetworkHand>(text, address.host, address.port, joints);
  }
  return target;
}

}  // namespace

std::vector<int> device_variables(const planning::PlanningProblem& problem,
                                  const std::string& kind) {
  std::vector<int> variables = kind == "arm" ? problem.arm : problem.hand;
  std::ranges::sort(variables);
  return variables;
}

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
    if (!targets.empty() && targets.front().kind == target.kind) {
      throw geometric::InputError(
          {"--to", "", "two devices for the " + target.kind, "one arm and one hand at most", ""});
    }
    targets.push_back(std::move(target));
  }
  if (targets.empty()) {
    refuse(text);
  }
  // An arm can hold at its points only, and is asked first when all shall hold together.
  std::ranges::stable_partition(targets, [](const auto& target) { return target.kind == "arm"; });
  return targets;
}

}  // namespace handway::execution
