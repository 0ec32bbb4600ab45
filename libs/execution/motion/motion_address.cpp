#include "motion/motion_address.h"

#include "handway/device/arm/val3_arm.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>

namespace handway::execution {
namespace {

constexpr const char* kScheme = "://";
constexpr const char* kDefaultController = "/joint_trajectory_controller";

[[noreturn]] void refuse(const std::string& found) {
  throw geometric::InputError(
      {"--to", "", fmt::format("\"{}\"", found),
       "arm://HOST[:PORT], hand://HOST[:PORT], both with a comma between, or "
       "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]",
       "Write, for example, arm://localhost:11000."});
}

/// Cuts `text` at the first `mark`. @returns what comes from the mark on.
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

}  // namespace

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

}  // namespace handway::execution
