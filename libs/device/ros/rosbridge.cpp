#include "handway/device/ros/rosbridge.h"

#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace handway::device {
namespace {

using Json = nlohmann::json;

constexpr double kNanosecond = 1e-9;  // s

// Null stands for a NaN or an infinity, as rosbridge writes them.
double number(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Eigen::VectorXd numbers(const Json& values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    result[static_cast<Eigen::Index>(i)] = number(values.at(i));
  }
  return result;
}

std::vector<double> list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

double duration(const Json& value) {
  return value.contains("secs")
             ? value.at("secs").get<double>() + kNanosecond * value.at("nsecs").get<double>()
             : value.at("sec").get<double>() + kNanosecond * value.at("nanosec").get<double>();
}

Json duration(double seconds, RosVersion version) {
  const auto nanoseconds = std::llround(seconds / kNanosecond);
  const bool ros1 = version == RosVersion::kRos1;
  return {{ros1 ? "secs" : "sec", nanoseconds / 1'000'000'000},
          {ros1 ? "nsecs" : "nanosec", nanoseconds % 1'000'000'000}};
}

RosJointState joint_state(const Json& message) {
  RosJointState state{message.at("name").get<std::vector<std::string>>(),
                      numbers(message.at("position"))};
  if (std::cmp_not_equal(state.names.size(), state.position.size())) {
    throw RosbridgeError(
        fmt::format("{} joints with {} positions", state.names.size(), state.position.size()));
  }
  return state;
}

RosTrajectory trajectory(const Json& message) {
  RosTrajectory result;
  result.names = message.at("joint_names").get<std::vector<std::string>>();
  std::vector<Eigen::VectorXd> positions;
  for (const Json& point : message.at("points")) {
    positions.push_back(numbers(point.at("positions")));
    if (std::cmp_not_equal(positions.back().size(), result.names.size())) {
      throw RosbridgeError(
          fmt::format("{} joints with {} positions", result.names.size(), positions.back().size()));
    }
    result.motion.times.push_back(duration(point.at("time_from_start")));
  }
  // The check comes first: otherwise a short message could request any size.
  result.motion.positions.resize(static_cast<Eigen::Index>(positions.size()),
                                 static_cast<Eigen::Index>(result.names.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    result.motion.positions.row(static_cast<Eigen::Index>(i)) = positions[i];
  }
  return result;
}

int integer(const Json& value) {
  constexpr std::int64_t kLeast = std::numeric_limits<int>::min();
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  // Numbers beyond the range of int64_t are not integers, or become negative.
  const bool fits = value.is_number_integer() && value.get<std::int64_t>() >= kLeast &&
                    value.get<std::int64_t>() <= kMost &&
                    !(value.is_number_unsigned() && value.get<std::int64_t>() < 0);
  if (!fits) {
    throw RosbridgeError(fmt::format("{} where a small whole number is due", quote(value.dump())));
  }
  return value.get<int>();
}

RobotStatus robot_status(const Json& message) {
  const auto value = [&](const char* key) { return integer(message.at(key).at("val")); };
  RobotStatus status;
  status.drives_powered = value("drives_powered");
  status.emergency_stopped = value("e_stopped");
  status.error_code = integer(message.at("error_code"));
  status.in_error = value("in_error");
  status.in_motion = value("in_motion");
  status.mode = value("mode");
  status.motion_possible = value("motion_possible");
  return status;
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

RosbridgeMessage parse_rosbridge(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    RosbridgeMessage message;
    message.op = json.at("op").get<std::string>();
    message.id = json.value("id", "");
    message.topic = json.value("topic", "");
    message.type = json.value("type", "");
    message.level = json.value("level", "");
    if (message.op == "status") {
      message.text = json.at("msg").get<std::string>();
    } else if (message.op == "publish") {
      const Json& body = json.at("msg");
      if (body.contains("joint_names")) {
        message.trajectory = trajectory(body);
      } else if (body.contains("name") && body.contains("position")) {
        message.joint_state = joint_state(body);
      } else if (body.contains("e_stopped")) {
        message.robot_status = robot_status(body);
      }
    }
    return message;
  } catch (const Json::exception& error) {
    throw RosbridgeError(quote(error.what()));
  }
}

std::string ros_type(std::string_view package, std::string_view name, RosVersion version) {
  return fmt::format("{}/{}{}", package, version == RosVersion::kRos1 ? "" : "msg/", name);
}

std::string advertise(const std::string& topic, const std::string& type) {
  return dump({{"op", "advertise"}, {"topic", topic}, {"type", type}});
}

std::string subscribe(const std::string& id, const std::string& topic, const std::string& type) {
  return dump({{"op", "subscribe"},
               {"id", id},
               {"topic", topic},
               {"type", type},
               {"throttle_rate", 0},
               {"queue_length", 1}});
}

std::string publish(const std::string& topic, const RosTrajectory& trajectory, RosVersion version) {
  Json points = Json::array();
  for (std::size_t i = 0; i < trajectory.motion.times.size(); ++i) {
    points.push_back(
        {{"positions", list(trajectory.motion.positions.row(static_cast<Eigen::Index>(i)))},
         {"time_from_start", duration(trajectory.motion.times[i], version)}});
  }
  return dump({{"op", "publish"},
               {"topic", topic},
               {"msg", {{"joint_names", trajectory.names}, {"points", std::move(points)}}}});
}

std::string publish(const std::string& topic, const RosJointState& state) {
  return dump({{"op", "publish"},
               {"topic", topic},
               {"msg",
                {{"name", state.names},
                 {"position", list(state.position)},
                 {"velocity", Json::array()},
                 {"effort", Json::array()}}}});
}

std::string publish(const std::string& topic, const RobotStatus& status) {
  const auto value = [](int number) { return Json{{"val", number}}; };
  return dump({{"op", "publish"},
               {"topic", topic},
               {"msg",
                {{"mode", value(status.mode)},
                 {"e_stopped", value(status.emergency_stopped)},
                 {"drives_powered", value(status.drives_powered)},
                 {"motion_possible", value(status.motion_possible)},
                 {"in_motion", value(status.in_motion)},
                 {"in_error", value(status.in_error)},
                 {"error_code", status.error_code}}}});
}

std::string status(const std::string& level, const std::string& text, const std::string& id) {
  Json message = {{"op", "status"}, {"level", level}, {"msg", text}};
  if (!id.empty()) {
    message["id"] = id;
  }
  return dump(message);
}

}  // namespace handway::device
