#include "handway/device/ros/ros_emulator.h"

#include "core/emulated_joints.h"
#include "handway/device/ros/ros_robot.h"
#include "ros/web_socket.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

namespace handway::device {
namespace {

constexpr double kOnLimit = 1e-6;
constexpr int kEstopCode = 1;
constexpr int kLimitCode = 2;

RosControllerSettings checked(RosControllerSettings settings) {
  if (settings.joints.count() == 0 || settings.position.size() != settings.joints.count() ||
      !(settings.braking_time > 0.0)) {
    throw std::invalid_argument("a robot in ROS needs joints and brakes");
  }
  return settings;
}

/// Where some of the joints are to go.
struct Goal {
  std::vector<Eigen::Index> joints;
  JointTrajectory motion;
  double begin = 0.0;       ///< s
  Eigen::VectorXd fastest;  ///< Of the motion, rad/s.
};

}  // namespace

struct RosController::Robot {
  explicit Robot(RosControllerSettings given)
      : settings(checked(std::move(given))),
        joints(settings.position, settings.joints.velocity / settings.braking_time, settings.lag) {}

  RosControllerSettings settings;
  EmulatedJoints joints;
  std::vector<Goal> goals;
  std::map<std::string, std::string> advertised;             ///< Topics with their types.
  std::map<std::uint64_t, std::set<std::string>> listening;  ///< Topics of each host.
  double now = 0.0;
  double moved = 0.0;
  bool has_moved = false;
  bool fault_active = false;
  int error_code = 0;

  [[nodiscard]] bool fault(FaultKind kind) const {
    return fault_active && settings.fault.kind == kind;
  }
  void step();
  void begin_fault();
  void stop(int code);
  void take(const RosTrajectory& trajectory);
  [[nodiscard]] Goal goal_of(const RosTrajectory& trajectory) const;
  void obey(std::uint64_t host, const RosbridgeMessage& message);
  [[nodiscard]] RobotStatus status() const;
};

void RosController::Robot::stop(int code) {
  error_code = code;
  goals.clear();
  joints.brake();
}

void RosController::Robot::begin_fault() {
  fault_active = true;
  if (settings.fault.kind == FaultKind::kEstop) {
    stop(kEstopCode);
  } else if (settings.fault.kind == FaultKind::kJointLimit) {
    stop(kLimitCode);
  }
}

void RosController::Robot::step() {
  now += kEmulationStep;
  const Eigen::VectorXd before = joints.commanded();
  Eigen::VectorXd next = before;
  for (const Goal& goal : goals) {
    const Eigen::VectorXd target = goal.motion.at(now - goal.begin);
    for (std::size_t k = 0; k < goal.joints.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double most = fault(FaultKind::kSlow) ? 0.5 * goal.fastest[i] * kEmulationStep
                                                  : std::numeric_limits<double>::infinity();
      next[goal.joints[k]] += std::clamp(target[i] - before[goal.joints[k]], -most, most);
    }
  }
  has_moved = has_moved || !goals.empty();
  joints.command(next, (next - before) / kEmulationStep);
  joints.step(kEmulationStep);
  std::erase_if(goals, [&](const Goal& goal) {
    return !fault(FaultKind::kSlow) && now - goal.begin > goal.motion.duration();
  });
  if (has_moved) {
    moved += kEmulationStep;
    if (!fault_active && settings.fault.kind != FaultKind::kNone && moved >= settings.fault.after) {
      begin_fault();
    }
  }
}

// @throws RosbridgeError for a trajectory that a controller refuses.
Goal RosController::Robot::goal_of(const RosTrajectory& trajectory) const {
  Goal goal;
  goal.begin = now;
  for (const std::string& name : trajectory.names) {
    const auto found = std::ranges::find(settings.joints.names, name);
    if (found == settings.joints.names.end()) {
      throw RosbridgeError(fmt::format("joint {} is none of this controller's", name));
    }
    goal.joints.push_back(found - settings.joints.names.begin());
  }
  const auto count = static_cast<Eigen::Index>(goal.joints.size());
  const Eigen::Index points = trajectory.motion.positions.rows();
  goal.motion.times = {0.0};
  goal.motion.positions.resize(points + 1, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    goal.motion.positions(0, j) = joints.commanded()[goal.joints[static_cast<std::size_t>(j)]];
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
      if (!(q >= settings.joints.lower[joint] - kOnLimit &&
            q <= settings.joints.upper[joint] + kOnLimit)) {
        throw RosbridgeError(fmt::format("joint {} would leave its limits",
                                         settings.joints.names[static_cast<std::size_t>(joint)]));
      }
      if (i > 1) {
        goal.fastest[j] =
            std::max(goal.fastest[j], std::abs(q - goal.motion.positions(i - 1, j)) / step);
      }
    }
  }
  return goal;
}

void RosController::Robot::take(const RosTrajectory& trajectory) {
  if (fault(FaultKind::kRefused)) {
    throw RosbridgeError("the controller is not running");
  }
  Goal goal = goal_of(trajectory);
  if (error_code != 0) {
    return;
  }
  // A joint has one goal at a time.
  std::erase_if(goals, [&](const Goal& other) {
    return std::ranges::any_of(other.joints, [&](Eigen::Index joint) {
      return std::ranges::find(goal.joints, joint) != goal.joints.end();
    });
  });
  if (!trajectory.motion.times.empty()) {
    goals.push_back(std::move(goal));
  }
}

// @throws RosbridgeError for what a rosbridge server complains about.
void RosController::Robot::obey(std::uint64_t host, const RosbridgeMessage& message) {
  if (message.op == "advertise") {
    advertised[message.topic] = message.type;
  } else if (message.op == "subscribe") {
    listening[host].insert(message.topic);
  } else if (message.op == "unsubscribe") {
    listening[host].erase(message.topic);
  } else if (message.op == "publish") {
    if (!advertised.contains(message.topic)) {
      throw RosbridgeError("topic " + message.topic + " was not advertised");
    }
    if (message.trajectory) {
      take(*message.trajectory);
    }
  } else if (message.op != "unadvertise") {
    throw RosbridgeError("unknown op " + message.op);
  }
}

RobotStatus RosController::Robot::status() const {
  const bool estopped = error_code == kEstopCode;
  RobotStatus status;
  status.drives_powered = estopped ? 0 : 1;
  status.emergency_stopped = estopped ? 1 : 0;
  status.error_code = error_code;
  status.in_error = error_code != 0 ? 1 : 0;
  status.in_motion = joints.moving() ? 1 : 0;
  status.mode = 2;
  status.motion_possible = error_code != 0 ? 0 : 1;
  return status;
}

RosController::RosController(RosControllerSettings settings)
    : robot_(std::make_unique<Robot>(std::move(settings))) {}

RosController::~RosController() = default;

RosController::Messages RosController::receive(std::uint64_t host, const std::string& text,
                                               double now) {
  advance(now);
  std::string id;
  try {
    const RosbridgeMessage message = parse_rosbridge(text);
    id = message.id;
    robot_->obey(host, message);
    return {};
  } catch (const RosbridgeError& error) {
    return {device::status("error", error.what(), id)};
  }
}

void RosController::advance(double now) {
  while (robot_->now + kEmulationStep <= now) {
    robot_->step();
  }
}

RosController::Messages RosController::feedback(std::uint64_t host) {
  Messages messages;
  const std::set<std::string>& topics = robot_->listening[host];
  if (topics.contains(kJointStatesTopic)) {
    messages.push_back(publish(kJointStatesTopic, RosJointState{robot_->settings.joints.names,
                                                                robot_->joints.position()}));
  }
  if (topics.contains(kRobotStatusTopic)) {
    messages.push_back(publish(kRobotStatusTopic, robot_->status()));
  }
  return messages;
}

const Eigen::VectorXd& RosController::position() const { return robot_->joints.position(); }

bool RosController::moving() const { return robot_->joints.moving(); }

FaultKind RosController::active_fault() const {
  return robot_->fault_active ? robot_->settings.fault.kind : FaultKind::kNone;
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kTick{1000};
constexpr double kFeedbackPeriod = 0.01;  // s

}  // namespace

struct RosEmulator::Running {
  Running(const RosControllerSettings& settings, std::uint16_t given)
      : controller(settings),
        port(given),
        address("ros://localhost:" + std::to_string(port.port())) {}

  struct Due {
    double time = 0.0;  ///< s
    WebSocketPort::Message message;
  };

  mutable std::mutex mutex;  ///< Of the controller.
  RosController controller;
  WebSocketPort port;
  std::string address;
  std::deque<Due> sent;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void send(WebSocketPort::Host host, const RosController::Messages& messages, double now);
  [[nodiscard]] double delay() const {
    return controller.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void RosEmulator::Running::send(WebSocketPort::Host host, const RosController::Messages& messages,
                                double now) {
  for (const std::string& text : messages) {
    sent.push_back({now + delay(), {host, text}});
  }
}

void RosEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  double last_feedback = 0.0;
  bool cut = false;
  while (!stop.stop_requested()) {
    const std::vector<WebSocketPort::Message> messages = port.serve(kTick);
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    controller.advance(now);
    for (const WebSocketPort::Message& message : messages) {
      send(message.host, controller.receive(message.host, message.text, now), now);
    }
    if (now - last_feedback >= kFeedbackPeriod) {
      last_feedback = now;
      for (const WebSocketPort::Host host : port.hosts()) {
        send(host, controller.feedback(host), now);
      }
    }
    if (controller.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      port.disconnect();
    }
    while (!sent.empty() && sent.front().time <= now) {
      port.send(sent.front().message.host, std::move(sent.front().message.text));
      sent.pop_front();
    }
  }
}

RosEmulator::RosEmulator(const RosControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

RosEmulator::~RosEmulator() = default;

const std::string& RosEmulator::address() const { return running_->address; }

Eigen::VectorXd RosEmulator::position() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.position();
}

bool RosEmulator::moving() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.moving();
}

}  // namespace handway::device
