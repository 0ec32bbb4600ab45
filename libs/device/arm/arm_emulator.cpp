#include "handway/device/arm/arm_emulator.h"

#include "core/emulated_joints.h"
#include "core/ports.h"
#include "handway/device/core/device_error.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace handway::device {
namespace {

constexpr int kStatusPeriod = 5;   // positions from status to status
constexpr double kOnLimit = 1e-5;  // rad: positions travel as float32
constexpr int kEstopCode = 1;

struct Move {
  Eigen::VectorXd target;
  double velocity;  // share of the joints' velocities
};

Val3ControllerSettings checked(Val3ControllerSettings settings) {
  const Eigen::Index count = settings.joints.count();
  if (count == 0 || count > static_cast<Eigen::Index>(kSimpleMessageJoints) ||
      settings.position.size() != count || settings.queue == 0 || !(settings.braking_time > 0.0)) {
    throw std::invalid_argument("an arm controller needs 1 to 10 joints, a queue and brakes");
  }
  return settings;
}

}  // namespace

struct Val3Controller::Arm {
  explicit Arm(Val3ControllerSettings given)
      : settings(checked(std::move(given))),
        joints(settings.position, settings.joints.velocity / settings.braking_time, settings.lag),
        powered(settings.powered) {}

  Val3ControllerSettings settings;
  EmulatedJoints joints;
  bool powered;
  bool estopped = false;
  std::deque<Move> queue;  ///< The first is under way.
  double now = 0.0;
  double moved = 0.0;      ///< s since the first motion began
  bool has_moved = false;  ///< A motion began.
  int fed_back = 0;        ///< Times that positions were sent.
  int stops = 0;           ///< Commands.
  bool fault_active = false;

  void step();
  void follow(double dt);
  void stop();
  void begin_fault();
  [[nodiscard]] bool fault(FaultKind kind) const {
    return fault_active && settings.fault.kind == kind;
  }
  [[nodiscard]] bool accepts(const SimpleMessage& point);
  [[nodiscard]] bool in_range(const Eigen::VectorXd& target) const;
  [[nodiscard]] RobotStatus status() const;
};

void Val3Controller::Arm::stop() {
  queue.clear();
  joints.brake();
}

void Val3Controller::Arm::begin_fault() {
  fault_active = true;
  if (settings.fault.kind == FaultKind::kEstop) {
    estopped = true;
    powered = false;
    stop();
  } else if (settings.fault.kind == FaultKind::kJointLimit && !queue.empty()) {
    // Of the joint that goes farthest.
    Eigen::Index joint = 0;
    const Eigen::VectorXd displacement = queue.back().target - joints.commanded();
    displacement.cwiseAbs().maxCoeff(&joint);
    (displacement[joint] > 0.0 ? settings.joints.upper : settings.joints.lower)[joint] =
        joints.commanded()[joint];
  }
}

// Along the queue, from target to target, for `dt` s.
void Val3Controller::Arm::follow(double dt) {
  const double pace = fault(FaultKind::kSlow) ? 0.5 : 1.0;
  Eigen::VectorXd at = joints.commanded();
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(at.size());
  while (dt > 0.0 && !queue.empty()) {
    const Eigen::VectorXd displacement = queue.front().target - at;
    const double needed =
        (displacement.cwiseAbs().array() / settings.joints.velocity.array()).maxCoeff() /
        (queue.front().velocity * pace);
    if (needed <= dt) {
      at = queue.front().target;
      dt -= needed;
      queue.pop_front();
    } else {
      velocity = displacement / needed;
      at += velocity * dt;
      dt = 0.0;
    }
  }
  joints.command(at, velocity);
}

void Val3Controller::Arm::step() {
  now += kEmulationStep;
  if (!queue.empty()) {
    has_moved = true;
    follow(kEmulationStep);
  } else {
    joints.command(joints.commanded(), Eigen::VectorXd::Zero(joints.commanded().size()));
  }
  joints.step(kEmulationStep);
  if (has_moved) {
    moved += kEmulationStep;
    if (!fault_active && settings.fault.kind != FaultKind::kNone && moved >= settings.fault.after) {
      begin_fault();
    }
  }
}

bool Val3Controller::Arm::in_range(const Eigen::VectorXd& target) const {
  return (target.array() >= settings.joints.lower.array() - kOnLimit).all() &&
         (target.array() <= settings.joints.upper.array() + kOnLimit).all();
}

bool Val3Controller::Arm::accepts(const SimpleMessage& point) {
  Move move{Eigen::VectorXd(settings.joints.count()), static_cast<double>(point.velocity)};
  for (Eigen::Index j = 0; j < move.target.size(); ++j) {
    move.target[j] = static_cast<double>(point.joints[static_cast<std::size_t>(j)]);
  }
  if (!powered || !settings.automatic || estopped || fault(FaultKind::kRefused) ||
      !(move.velocity > 0.0 && move.velocity <= 1.0) || !in_range(move.target) ||
      queue.size() >= settings.queue) {
    return false;
  }
  joints.release();
  queue.push_back(std::move(move));
  return true;
}

RobotStatus Val3Controller::Arm::status() const {
  RobotStatus status;
  status.drives_powered = powered ? 1 : 0;
  status.emergency_stopped = estopped ? 1 : 0;
  status.error_code = estopped ? kEstopCode : 0;
  status.in_error = estopped ? 1 : 0;
  status.in_motion = joints.moving() ? 1 : 0;
  status.mode = settings.automatic ? 2 : 1;
  status.motion_possible = powered && settings.automatic && !estopped ? 1 : 0;
  return status;
}

Val3Controller::Val3Controller(Val3ControllerSettings settings)
    : arm_(std::make_unique<Arm>(std::move(settings))) {}

Val3Controller::~Val3Controller() = default;

SimpleMessage Val3Controller::receive(const SimpleMessage& message, double now) {
  advance(now);
  SimpleMessage reply;
  reply.type = message.type;
  reply.kind = SimpleMessageKind::kReply;
  reply.sequence = message.sequence;
  reply.reply = SimpleMessageReply::kFailure;
  if (message.type == SimpleMessageType::kJointTrajectoryPoint &&
      message.kind == SimpleMessageKind::kRequest) {
    const bool stop = message.sequence == kStopSequence;
    if (stop) {
      ++arm_->stops;
      arm_->stop();
    }
    if (stop || arm_->accepts(message)) {
      reply.reply = SimpleMessageReply::kSuccess;
    }
  }
  return reply;
}

void Val3Controller::advance(double now) {
  while (arm_->now + kEmulationStep <= now) {
    arm_->step();
  }
}

std::vector<SimpleMessage> Val3Controller::feedback() {
  SimpleMessage position;
  for (Eigen::Index j = 0; j < arm_->settings.joints.count(); ++j) {
    position.joints[static_cast<std::size_t>(j)] = static_cast<float>(arm_->joints.position()[j]);
  }
  std::vector<SimpleMessage> feedback{position};
  if (arm_->fed_back++ % kStatusPeriod == 0) {
    SimpleMessage status;
    status.type = SimpleMessageType::kStatus;
    status.status = arm_->status();
    feedback.push_back(status);
  }
  return feedback;
}

void Val3Controller::connection_lost() { arm_->stop(); }

const Eigen::VectorXd& Val3Controller::position() const { return arm_->joints.position(); }

bool Val3Controller::moving() const { return arm_->joints.moving(); }

int Val3Controller::stops() const { return arm_->stops; }

FaultKind Val3Controller::active_fault() const {
  return arm_->fault_active ? arm_->settings.fault.kind : FaultKind::kNone;
}

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

constexpr double kFeedbackPeriod = 0.02;  // s
constexpr microseconds kTick{1000};
constexpr int kStatePortOffset = 2;
constexpr int kPortAttempts = 50;

struct Ports {
  std::unique_ptr<TcpHostPort> motion;
  std::unique_ptr<TcpHostPort> state;
};

Ports open_ports(std::uint16_t port) {
  for (int attempt = 1;; ++attempt) {
    Ports ports;
    ports.motion = std::make_unique<TcpHostPort>(port);
    const int state = ports.motion->port() + kStatePortOffset;
    try {
      ports.state = std::make_unique<TcpHostPort>(static_cast<std::uint16_t>(state));
      return ports;
    } catch (const DeviceError&) {
      if (port != 0 || attempt == kPortAttempts) {
        throw;
      }
    }
  }
}

}  // namespace

struct ArmEmulator::Running {
  Running(const Val3ControllerSettings& settings, std::uint16_t port)
      : controller(settings),
        ports(open_ports(port)),
        address("arm://" + ports.motion->address()) {}

  mutable std::mutex mutex;  ///< Of the controller.
  Val3Controller controller;
  Ports ports;
  std::string address;
  SimpleMessageParser parser;
  DelayedBytes replies;
  DelayedBytes feedback;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void take(std::span<const std::uint8_t> bytes, double now);
  [[nodiscard]] double delay() const {
    return controller.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void ArmEmulator::Running::take(std::span<const std::uint8_t> bytes, double now) {
  parser.add(bytes);
  try {
    while (const auto message = parser.next()) {
      replies.add(encode(controller.receive(*message, now)), now + delay());
    }
  } catch (const SimpleMessageError&) {
    ports.motion->disconnect();
  }
}

void ArmEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  HostWatch motion(*ports.motion);
  HostWatch state(*ports.state);
  double last_feedback = 0.0;
  bool cut = false;
  std::array<std::uint8_t, 4096> bytes{};
  while (!stop.stop_requested()) {
    const std::size_t count = ports.motion->read(bytes, kTick);
    std::array<std::uint8_t, 64> ignored{};
    ports.state->read(ignored, microseconds(0));
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    controller.advance(now);
    const bool motion_lost = motion.lost();
    if (motion_lost) {
      parser = {};
      replies.clear();
    }
    const bool state_lost = state.lost();
    if (motion_lost || state_lost) {
      controller.connection_lost();
    }
    take(std::span(bytes).first(count), now);
    if (now - last_feedback >= kFeedbackPeriod) {
      last_feedback = now;
      for (const SimpleMessage& message : controller.feedback()) {
        feedback.add(encode(message), now + delay());
      }
    }
    if (controller.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      ports.motion->disconnect();
      ports.state->disconnect();
    }
    replies.send(*ports.motion, now);
    feedback.send(*ports.state, now);
  }
}

ArmEmulator::ArmEmulator(const Val3ControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

ArmEmulator::~ArmEmulator() = default;

const std::string& ArmEmulator::address() const { return running_->address; }

Eigen::VectorXd ArmEmulator::position() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.position();
}

bool ArmEmulator::moving() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.moving();
}

int ArmEmulator::stops() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.stops();
}

}  // namespace handway::device
