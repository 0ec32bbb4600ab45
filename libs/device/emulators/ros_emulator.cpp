#include "handway/device/emulators/ros_emulator.h"

#include "emulators/emulator_thread.h"
#include "handway/device/ros/ros_robot.h"
#include "ros/web_socket.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace handway::device {
namespace {

constexpr double kOnLimit = 1e-6;
constexpr int kEstopCode = 1;
constexpr int kLimitCode = 2;

}  // namespace

void RosController::stop(int code) {
  error_code_ = code;
  goals_.clear();
  brake();
}

void RosController::do_fail() {
  if (active_fault() == FaultKind::kEstop) {
    stop(kEstopCode);
  } else if (active_fault() == FaultKind::kJointLimit) {
    stop(kLimitCode);
  }
}

bool RosController::do_step() {
  const bool moves = !goals_.empty();
  const Eigen::VectorXd before = commanded();
  Eigen::VectorXd next = before;
  for (const Goal& goal : goals_) {
    const Eigen::VectorXd target = goal.motion.at(now() - goal.begin);
    for (std::size_t k = 0; k < goal.joints.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double most = active_fault() == FaultKind::kSlow
                              ? 0.5 * goal.fastest[i] * kStep
                              : std::numeric_limits<double>::infinity();
      next[goal.joints[k]] += std::clamp(target[i] - before[goal.joints[k]], -most, most);
    }
  }
  command(next, (next - before) / kStep);
  std::erase_if(goals_, [&](const Goal& goal) {
    return active_fault() != FaultKind::kSlow && now() - goal.begin > goal.motion.duration();
  });
  return moves;
}

// @throws RosbridgeError for a trajectory that a controller refuses.
RosController::Goal RosController::goal_of(const RosTrajectory& trajectory) const {
  Goal goal;
  goal.begin = now();
  for (const std::string& name : trajectory.names) {
    const auto found = std::ranges::find(joints().names, name);
    if (found == joints().names.end()) {
      throw RosbridgeError(fmt::format("joint {} is none of this controller's", name));
    }
    goal.joints.push_back(found - joints().names.begin());
  }
  const auto count = static_cast<Eigen::Index>(goal.joints.size());
  const Eigen::Index points = trajectory.motion.positions.rows();
  goal.motion.times = {0.0};
  goal.motion.positions.resize(points + 1, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    goal.motion.positions(0, j) = commanded()[goal.joints[static_cast<std::size_t>(j)]];
  }
  goal.motion.positions.bottomRows(points) = trajectory.motion.positions;
  goal.fastest = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 1; i <= points; ++i) {
    const double time = trajectory.motion.times[static_cast<std::size_t>(i - 1)];
    const double step = time - goal.motion.times.back();
    if (!(step > 0.0)) {
      throw RosbridgeError("points have to be in order of time");
    }
    goal.motion.times.push_back(time);
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::Index joint = goal.joints[static_cast<std::size_t>(j)];
      const double q = goal.motion.positions(i, j);
      if (!(q >= joints().lower[joint] - kOnLimit && q <= joints().upper[joint] + kOnLimit)) {
        throw RosbridgeError(fmt::format("joint {} would leave its limits",
                                         joints().names[static_cast<std::size_t>(joint)]));
      }
      if (i > 1) {
        goal.fastest[j] =
            std::max(goal.fastest[j], std::abs(q - goal.motion.positions(i - 1, j)) / step);
      }
    }
  }
  return goal;
}

void RosController::take(const RosTrajectory& trajectory) {
  if (active_fault() == FaultKind::kRefused) {
    throw RosbridgeError("the controller is not running");
  }
  Goal goal = goal_of(trajectory);
  if (error_code_ != 0) {
    return;
  }
  // A joint has one goal at a time.
  std::erase_if(goals_, [&](const Goal& other) {
    return std::ranges::any_of(other.joints, [&](Eigen::Index joint) {
      return std::ranges::find(goal.joints, joint) != goal.joints.end();
    });
  });
  if (!trajectory.motion.times.empty()) {
    goals_.push_back(std::move(goal));
  }
}

// @throws RosbridgeError for messages that a rosbridge server rejects.
void RosController::obey(std::uint64_t host, const RosbridgeMessage& message) {
  if (message.op == "advertise") {
    advertised_[message.topic] = message.type;
  } else if (message.op == "subscribe") {
    listening_[host].insert(message.topic);
  } else if (message.op == "unsubscribe") {
    listening_[host].erase(message.topic);
  } else if (message.op == "publish") {
    if (!advertised_.contains(message.topic)) {
      throw RosbridgeError("topic " + message.topic + " was not advertised");
    }
    if (message.trajectory) {
      take(*message.trajectory);
    }
  } else if (message.op != "unadvertise") {
    throw RosbridgeError("unknown op " + message.op);
  }
}

RobotStatus RosController::status() const {
  const bool estopped = error_code_ == kEstopCode;
  RobotStatus status;
  status.drives_powered = estopped ? 0 : 1;
  status.emergency_stopped = estopped ? 1 : 0;
  status.error_code = error_code_;
  status.in_error = error_code_ != 0 ? 1 : 0;
  status.in_motion = moving() ? 1 : 0;
  status.mode = 2;
  status.motion_possible = error_code_ != 0 ? 0 : 1;
  return status;
}

RosController::Messages RosController::receive(std::uint64_t host, const std::string& text,
                                               double now) {
  advance(now);
  std::string id;
  try {
    const RosbridgeMessage message = parse_rosbridge(text);
    id = message.id;
    obey(host, message);
    return {};
  } catch (const RosbridgeError& error) {
    return {device::status("error", error.what(), id)};
  }
}

RosController::Messages RosController::feedback(std::uint64_t host) {
  Messages messages;
  const std::set<std::string>& topics = listening_[host];
  if (topics.contains(kJointStatesTopic)) {
    messages.push_back(publish(kJointStatesTopic, RosJointState{joints().names, position()}));
  }
  if (topics.contains(kRobotStatusTopic)) {
    messages.push_back(publish(kRobotStatusTopic, status()));
  }
  return messages;
}

namespace {

constexpr double kFeedbackPeriod = 0.01;  // s

/// The port of the rosbridge server.
class RosbridgePort {
 public:
  explicit RosbridgePort(std::uint16_t port) : port_(port) {}

  [[nodiscard]] std::string address() const {
    return "ros://localhost:" + std::to_string(port_.port());
  }
  void wait(std::chrono::microseconds time) { received_ = port_.serve(time); }
  void disconnect() { port_.disconnect(); }

  void take(RosController& controller, double now) {
    for (const auto& [host, text] : received_) {
      add(host, controller.receive(host, text, now), now + delay_of(controller.active_fault()));
    }
  }
  void report(RosController& controller, double now) {
    for (const WebSocketPort::Host host : port_.hosts()) {
      add(host, controller.feedback(host), now + delay_of(controller.active_fault()));
    }
  }
  void send(double now) {
    while (!said_.empty() && said_.front().time <= now) {
      port_.send(said_.front().host, std::move(said_.front().text));
      said_.pop_front();
    }
  }

 private:
  struct Due {
    double time = 0.0;  ///< s
    WebSocketPort::Host host = 0;
    std::string text;
  };

  void add(WebSocketPort::Host host, const RosController::Messages& messages, double due) {
    for (const std::string& text : messages) {
      said_.push_back({due, host, text});
    }
  }

  WebSocketPort port_;
  std::vector<WebSocketPort::Message> received_;
  std::deque<Due> said_;
};

}  // namespace

RosEmulator::RosEmulator(const RosControllerSettings& settings, std::uint16_t port)
    : RobotEmulator(std::make_unique<RunningRobot<RosController, RosbridgePort>>(kFeedbackPeriod,
                                                                                 settings, port)) {}

}  // namespace handway::device
