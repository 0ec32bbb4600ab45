#include "handway/device/ros/ros_robot.h"

#include "core/links.h"
#include "handway/device/core/device_error.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/line_protocol.h"
#include "ros/web_socket.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace handway::device {
namespace {

/// Length of motion that is sent to a device at once, s.
struct WindowLength {
  double follow = 0.2;  ///< Planned motion, …
  double brake = 0.25;  ///< and braking to rest.
};

constexpr double kFirst = 0.005;     // s: a point that is due at once is late when it arrives
constexpr double kApart = 1e-3;      // s, of two points, at least
constexpr double kBrakeStep = 0.01;  // s, while braking

// Makes the next stretch of a motion, complete in itself: a device that receives no more follows it
// to its end and rests, having braked on the planned path.
// @param time its start, s of `motion`; its own times begin a few ms after 0 and end with `length`,
// or with the motion.
JointTrajectory motion_window(const JointTrajectory& motion, double time,
                              const WindowLength& length) {
  std::vector<double> own;
  std::vector<double> planned;
  const auto add = [&](double when, double where) {
    if (when >= kFirst && (own.empty() || when >= own.back() + kApart)) {
      own.push_back(when);
      planned.push_back(where);
    }
  };
  const double end = motion.duration();
  const double until = time + length.follow;
  const auto next = std::ranges::upper_bound(motion.times, time);
  for (auto point = next; point != motion.times.end() && *point < until; ++point) {
    add(*point - time, *point);
  }
  if (until >= end) {
    add(std::max({kFirst, end - time, own.empty() ? 0.0 : own.back() + kApart}), end);
  } else {
    for (double t = 0.0; t < length.brake - kApart; t += kBrakeStep) {
      add(length.follow + t, until + t - 0.5 * t * t / length.brake);
    }
    add(length.follow + length.brake, until + 0.5 * length.brake);
  }
  JointTrajectory window{std::move(own), Eigen::MatrixXd(static_cast<Eigen::Index>(planned.size()),
                                                         motion.positions.cols())};
  for (std::size_t i = 0; i < planned.size(); ++i) {
    window.positions.row(static_cast<Eigen::Index>(i)) = motion.at(planned[i]);
  }
  return window;
}

using Clock = TrajectoryClient::Clock;
using std::chrono::milliseconds;

constexpr milliseconds kSendPeriod{50};
constexpr WindowLength kWindow;
// Duration of braking for a stop, s.
constexpr double kStopBrake = 0.15;
// Longest delay of a robot that follows positions, s.
constexpr double kLeadSlack = 0.2;
// Number of messages about other joints until giving up.
constexpr int kPatience = 200;
constexpr const char* kStatusId = "handway-robot-status";

}  // namespace

struct RosRobot::Wire {
  RosAddress address;
  std::unique_ptr<WebSocketLink> link;
  Eigen::VectorXd position;
  std::vector<bool> fresh;  ///< Joints reported since the last sample.
  std::vector<bool> known;
  int messages = 0;  ///< About joints.
  std::optional<RobotStatus> status;
  bool watched = false;  ///< A motion is running, or paused.
  bool sending = false;
  Clock::time_point sent;
  double time = 0.0;  ///< Time of the motion at the last update().
  Clock::time_point updated;

  [[nodiscard]] double time_now() const {
    return time + std::chrono::duration<double>(Clock::now() - updated).count();
  }
};

std::string trajectory_topic(const std::string& controller, RosVersion version) {
  return controller + (version == RosVersion::kRos1 ? "/command" : "/joint_trajectory");
}

RosRobot::RosRobot(std::string name, RosAddress address, JointRanges joints)
    : TrajectoryClient(std::move(name), std::move(joints)), wire_(std::make_unique<Wire>()) {
  wire_->address = std::move(address);
}

RosRobot::~RosRobot() = default;

void RosRobot::do_connect(const std::stop_token& stop) {
  const RosAddress address = wire_->address;
  *wire_ = {};
  wire_->address = address;
  wire_->position = Eigen::VectorXd::Zero(joints().count());
  wire_->fresh.assign(joints().names.size(), false);
  wire_->known = wire_->fresh;
  wire_->link =
      std::make_unique<WebSocketLink>(name(), TcpAddress{address.host, address.port}, stop);
  wire_->link->send(advertise(address.trajectory_topic,
                              ros_type("trajectory_msgs", "JointTrajectory", address.version)));
  wire_->link->send(subscribe("handway-joint-states", kJointStatesTopic,
                              ros_type("sensor_msgs", "JointState", address.version)));
  wire_->link->send(subscribe(kStatusId, kRobotStatusTopic,
                              ros_type("industrial_msgs", "RobotStatus", address.version)));
}

void RosRobot::do_upload(const JointTrajectory& /*trajectory*/, const std::stop_token& /*stop*/) {
  // It is sent while it runs.
}

void RosRobot::do_start() {
  if (wire_->status) {
    if (const auto obstacle = obstacle_to_start(*wire_->status)) {
      refuse(obstacle->found, "a robot that can move", obstacle->advice);
    }
  }
  wire_->time = 0.0;
  wire_->updated = Clock::now();
  wire_->watched = true;
  wire_->sending = true;
  wire_->sent = {};
}

double RosRobot::do_pause(double time) {
  const double now = wire_->time_now();
  const double hold = std::min(std::max(time, now + 0.5 * kStopBrake), trajectory().duration());
  wire_->sending = false;
  send_window(now, std::max(0.0, hold - now - 0.5 * kStopBrake), kStopBrake);
  return hold;
}

void RosRobot::do_resume() {
  wire_->sending = true;
  wire_->sent = {};
}

void RosRobot::do_stop() {
  const bool moving = wire_->sending;
  wire_->watched = false;
  wire_->sending = false;
  if (moving) {
    send_window(wire_->time_now(), 0.0, kStopBrake);
  } else if (wire_->link && phase() == MotionPhase::kPaused) {
    // The robot may not have reached the point of the pause yet.
    RosTrajectory here{joints().names, {{kStopBrake}, measured().position.transpose()}};
    publish_motion(here);
  }
}

bool RosRobot::do_update(double time) {
  wire_->time = time;
  wire_->updated = Clock::now();
  const bool all = read();
  if (wire_->sending && phase() == MotionPhase::kRunning &&
      Clock::now() - wire_->sent >= kSendPeriod &&
      time < trajectory().duration() + kWindow.follow) {
    send_window(time, kWindow.follow, kWindow.brake);
    wire_->sent = Clock::now();
  }
  return all;
}

void RosRobot::lead(const Eigen::VectorXd& position, double time) {
  if (phase() != MotionPhase::kIdle || !wire_->link) {
    refuse(fault().empty() ? "a motion of its own" : fault(), "a connected robot that has none",
           "Connect again.");
  }
  if (wire_->status) {
    if (const auto obstacle = obstacle_to_start(*wire_->status)) {
      refuse(obstacle->found, "a robot that can move", obstacle->advice);
    }
  }
  JointTrajectory lead{{0.0, time + kLeadSlack}, Eigen::MatrixXd(2, joints().count())};
  lead.positions.row(0) = measured().position.cwiseMax(joints().lower).cwiseMin(joints().upper);
  lead.positions.row(1) = position;
  check_trajectory(lead, joints());
  publish_motion({joints().names, {{time}, position.transpose()}});
}

void RosRobot::send_window(double time, double follow, double brake) {
  publish_motion({joints().names, motion_window(trajectory(), time, {follow, brake})});
}

void RosRobot::publish_motion(const RosTrajectory& motion) {
  wire_->link->send(publish(wire_->address.trajectory_topic, motion, wire_->address.version),
                    ByteLink::kLongestCommand);
}

bool RosRobot::read() {
  bool all = true;
  try {
    auto text = wire_->link->receive(milliseconds(1));
    for (ReadBudget budget; text && all;) {
      take(parse_rosbridge(*text));
      budget.spend(text->size());
      all = !budget.spent();
      if (all) {
        text = wire_->link->receive(milliseconds(0));
      }
    }
  } catch (const RosbridgeError& error) {
    refuse(error.what(), "rosbridge messages",
           "Look whether the port is that of a rosbridge server.");
  }
  if (wire_->watched && wire_->status) {
    if (const auto obstacle = obstacle_under_way(*wire_->status)) {
      refuse(obstacle->found, "none", obstacle->advice);
    }
  }
  return all;
}

void RosRobot::take(const RosbridgeMessage& message) {
  if (message.op == "status") {
    // Many robots have neither this topic nor the type.
    if (message.level == "error" && message.id != kStatusId) {
      refuse(quote(message.text), "a rosbridge server that accepts the command",
             "Look whether topic and ROS version are right and the controller runs.");
    }
  } else if (message.joint_state && message.topic == kJointStatesTopic) {
    take_joints(*message.joint_state);
  } else if (message.robot_status && message.topic == kRobotStatusTopic) {
    wire_->status = message.robot_status;
  }
}

void RosRobot::take_joints(const RosJointState& state) {
  for (std::size_t i = 0; i < state.names.size(); ++i) {
    const auto found = std::ranges::find(joints().names, state.names[i]);
    if (found == joints().names.end()) {
      continue;
    }
    const auto joint = found - joints().names.begin();
    const double value = state.position[static_cast<Eigen::Index>(i)];
    if (!std::isfinite(value)) {
      refuse(fmt::format("joint {} at no number", *found), "its position",
             "Look at the robot's driver.");
    }
    wire_->position[joint] = value;
    wire_->fresh[static_cast<std::size_t>(joint)] = true;
    wire_->known[static_cast<std::size_t>(joint)] = true;
  }
  if (std::ranges::all_of(wire_->fresh, [](bool reported) { return reported; })) {
    add_sample(wire_->position);
    wire_->fresh.assign(wire_->fresh.size(), false);
  } else if (const auto missing = std::ranges::find(wire_->known, false);
             missing != wire_->known.end() && ++wire_->messages > kPatience) {
    refuse(fmt::format("no position of joint {} on {}",
                       joints().names[static_cast<std::size_t>(missing - wire_->known.begin())],
                       kJointStatesTopic),
           "positions of all joints", "Look whether joints have the same names in ROS.");
  }
}

}  // namespace handway::device
