#include "handway/device/emulators/emulated_robot.h"

#include "emulators/emulator_thread.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr double kAtRest = 1e-3;  // rad/s

}  // namespace

EmulatedRobot::EmulatedRobot(const EmulatedRobotSettings& settings)
    : joints_(settings.joints),
      fault_(settings.fault),
      lag_(settings.lag),
      deceleration_(joints_.velocity / settings.braking_time),
      position_(settings.position),
      velocity_(Eigen::VectorXd::Zero(position_.size())),
      command_(position_),
      command_velocity_(velocity_) {
  const Eigen::Index count = joints_.count();
  if (count == 0 || position_.size() != count || deceleration_.size() != count || !(lag_ > 0.0) ||
      !(settings.braking_time > 0.0) || !(deceleration_.array() > 0.0).all()) {
    throw std::invalid_argument("an emulated robot needs joints, a lag and brakes");
  }
}

void EmulatedRobot::advance(double now) {
  while (now_ + kStep <= now) {
    now_ += kStep;
    has_moved_ = do_step() || has_moved_;
    follow_command();
    moved_ += has_moved_ ? kStep : 0.0;
    if (has_moved_ && !fault_active_ && fault_.kind != FaultKind::kNone && moved_ >= fault_.after) {
      fault_active_ = true;
      do_fail();
    }
  }
}

void EmulatedRobot::command(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) {
  command_ = position;
  command_velocity_ = velocity;
}

void EmulatedRobot::brake() {
  if (!braking_) {
    const double duration =
        command_velocity_.cwiseQuotient(deceleration_).lpNorm<Eigen::Infinity>();
    braking_ = Braking{command_, command_velocity_, duration, 0.0};
  }
}

void EmulatedRobot::follow_command() {
  if (braking_) {
    braking_->time += kStep;
    const double t = std::min(braking_->time, braking_->duration);
    const double left = braking_->duration > 0.0 ? 1.0 - t / braking_->duration : 0.0;
    // The integral of a velocity that falls to 0 evenly.
    command_ = braking_->from + braking_->velocity * (0.5 * t * (1.0 + left));
    command_velocity_ = braking_->velocity * left;
  }
  const Eigen::VectorXd before = position_;
  position_ += (1.0 - std::exp(-kStep / lag_)) * (command_ - position_);
  velocity_ = (position_ - before) / kStep;
}

bool EmulatedRobot::moving() const { return velocity_.lpNorm<Eigen::Infinity>() > kAtRest; }

RobotEmulator::RobotEmulator(std::unique_ptr<Running> running) : running_(std::move(running)) {}

RobotEmulator::~RobotEmulator() = default;

const std::string& RobotEmulator::address() const { return running_->address(); }

Eigen::VectorXd RobotEmulator::position() const {
  Eigen::VectorXd position;
  running_->ask([&](const EmulatedRobot& robot) { position = robot.position(); });
  return position;
}

bool RobotEmulator::moving() const {
  bool moving = false;
  running_->ask([&](const EmulatedRobot& robot) { moving = robot.moving(); });
  return moving;
}

int RobotEmulator::stops() const {
  int stops = 0;
  running_->ask([&](const EmulatedRobot& robot) { stops = robot.stops(); });
  return stops;
}

}  // namespace handway::device
