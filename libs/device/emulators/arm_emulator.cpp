#include "handway/device/emulators/arm_emulator.h"

#include "core/ports.h"
#include "emulators/emulator_thread.h"
#include "handway/device/core/device_error.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr int kStatusPeriod = 5;   // positions from status to status
constexpr double kOnLimit = 1e-5;  // rad: positions travel as float32
constexpr int kEstopCode = 1;

}  // namespace

Val3Controller::Val3Controller(const Val3ControllerSettings& settings)
    : EmulatedRobot(settings),
      longest_queue_(settings.queue),
      powered_(settings.powered),
      automatic_(settings.automatic) {
  if (joints().count() > static_cast<Eigen::Index>(kSimpleMessageJoints) || longest_queue_ == 0) {
    throw std::invalid_argument("an arm controller needs 1 to 10 joints, a queue and brakes");
  }
}

void Val3Controller::stop() {
  queue_.clear();
  brake();
}

void Val3Controller::do_fail() {
  if (active_fault() == FaultKind::kEstop) {
    estopped_ = true;
    powered_ = false;
    stop();
  } else if (active_fault() == FaultKind::kJointLimit && !queue_.empty()) {
    // Moves a limit of the joint that goes farthest to the joint's present position.
    Eigen::Index joint = 0;
    const Eigen::VectorXd displacement = queue_.back().target - commanded();
    displacement.cwiseAbs().maxCoeff(&joint);
    (displacement[joint] > 0.0 ? joints().upper : joints().lower)[joint] = commanded()[joint];
  }
}

// Moves along the queue, from target to target, for `dt` s.
void Val3Controller::follow(double dt) {
  const double pace = active_fault() == FaultKind::kSlow ? 0.5 : 1.0;
  Eigen::VectorXd at = commanded();
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(at.size());
  while (dt > 0.0 && !queue_.empty()) {
    const Eigen::VectorXd displacement = queue_.front().target - at;
    const double needed = (displacement.cwiseAbs().array() / joints().velocity.array()).maxCoeff() /
                          (queue_.front().velocity * pace);
    if (needed <= dt) {
      at = queue_.front().target;
      dt -= needed;
      queue_.pop_front();
    } else {
      velocity = displacement / needed;
      at += velocity * dt;
      dt = 0.0;
    }
  }
  command(at, velocity);
}

bool Val3Controller::do_step() {
  const bool moves = !queue_.empty();
  if (moves) {
    follow(kStep);
  } else {
    command(commanded(), Eigen::VectorXd::Zero(commanded().size()));
  }
  return moves;
}

bool Val3Controller::in_range(const Eigen::VectorXd& target) const {
  return (target.array() >= joints().lower.array() - kOnLimit).all() &&
         (target.array() <= joints().upper.array() + kOnLimit).all();
}

bool Val3Controller::accepts(const SimpleMessage& point) {
  Move move{Eigen::VectorXd(joints().count()), static_cast<double>(point.velocity)};
  for (Eigen::Index j = 0; j < move.target.size(); ++j) {
    move.target[j] = static_cast<double>(point.joints[static_cast<std::size_t>(j)]);
  }
  if (!powered_ || !automatic_ || estopped_ || active_fault() == FaultKind::kRefused ||
      !(move.velocity > 0.0 && move.velocity <= 1.0) || !in_range(move.target) ||
      queue_.size() >= longest_queue_) {
    return false;
  }
  release();
  queue_.push_back(std::move(move));
  return true;
}

RobotStatus Val3Controller::status() const {
  RobotStatus status;
  status.drives_powered = powered_ ? 1 : 0;
  status.emergency_stopped = estopped_ ? 1 : 0;
  status.error_code = estopped_ ? kEstopCode : 0;
  status.in_error = estopped_ ? 1 : 0;
  status.in_motion = moving() ? 1 : 0;
  status.mode = automatic_ ? 2 : 1;
  status.motion_possible = powered_ && automatic_ && !estopped_ ? 1 : 0;
  return status;
}

SimpleMessage Val3Controller::receive(const SimpleMessage& message, double now) {
  advance(now);
  SimpleMessage reply;
  reply.type = message.type;
  reply.kind = SimpleMessageKind::kReply;
  reply.sequence = message.sequence;
  reply.reply = SimpleMessageReply::kFailure;
  if (message.type == SimpleMessageType::kJointTrajectoryPoint &&
      message.kind == SimpleMessageKind::kRequest) {
    const bool is_stop = message.sequence == kStopSequence;
    if (is_stop) {
      count_stop();
      stop();
    }
    if (is_stop || accepts(message)) {
      reply.reply = SimpleMessageReply::kSuccess;
    }
  }
  return reply;
}

std::vector<SimpleMessage> Val3Controller::feedback() {
  SimpleMessage positions;
  for (Eigen::Index j = 0; j < joints().count(); ++j) {
    positions.joints[static_cast<std::size_t>(j)] = static_cast<float>(position()[j]);
  }
  std::vector<SimpleMessage> feedback{positions};
  if (fed_back_++ % kStatusPeriod == 0) {
    SimpleMessage& last = feedback.emplace_back();
    last.type = SimpleMessageType::kStatus;
    last.status = status();
  }
  return feedback;
}

namespace {

using std::chrono::microseconds;

constexpr double kFeedbackPeriod = 0.02;  // s
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

/// The two ports of the controller.
class Val3Ports {
 public:
  explicit Val3Ports(std::uint16_t port) : ports_(open_ports(port)) {}

  [[nodiscard]] std::string address() const { return "arm://" + ports_.motion->address(); }
  void wait(microseconds time) {
    count_ = ports_.motion->read(bytes_, time);
    std::array<std::uint8_t, 64> ignored{};
    ports_.state->read(ignored, microseconds(0));
  }
  void disconnect() {
    ports_.motion->disconnect();
    ports_.state->disconnect();
  }
  void send(double now) {
    replies_.send(*ports_.motion, now);
    feedback_.send(*ports_.state, now);
  }

  void take(Val3Controller& controller, double now) {
    const bool motion_lost = motion_.lost();
    if (motion_lost) {
      parser_ = {};
      replies_.clear();
    }
    if (state_.lost() || motion_lost) {
      controller.connection_lost();
    }
    parser_.add(std::span(bytes_).first(count_));
    try {
      while (const auto message = parser_.next()) {
        const SimpleMessage reply = controller.receive(*message, now);
        replies_.add(encode(reply), now + delay_of(controller.active_fault()));
      }
    } catch (const SimpleMessageError&) {
      ports_.motion->disconnect();
    }
  }

  void report(Val3Controller& controller, double now) {
    for (const SimpleMessage& message : controller.feedback()) {
      feedback_.add(encode(message), now + delay_of(controller.active_fault()));
    }
  }

 private:
  Ports ports_;
  HostWatch motion_{*ports_.motion};
  HostWatch state_{*ports_.state};
  std::array<std::uint8_t, 4096> bytes_{};
  std::size_t count_ = 0;
  SimpleMessageParser parser_;
  DelayedBytes replies_;
  DelayedBytes feedback_;
};

}  // namespace

ArmEmulator::ArmEmulator(const Val3ControllerSettings& settings, std::uint16_t port)
    : RobotEmulator(std::make_unique<RunningRobot<Val3Controller, Val3Ports>>(kFeedbackPeriod,
                                                                              settings, port)) {}

}  // namespace handway::device
