#include "emulated_joints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr double kAtRest = 1e-3;  // rad/s

}  // namespace

EmulatedJoints::EmulatedJoints(const Eigen::VectorXd& position, Eigen::VectorXd deceleration,
                               double lag)
    : position_(position),
      velocity_(Eigen::VectorXd::Zero(position.size())),
      command_(position),
      command_velocity_(velocity_),
      deceleration_(std::move(deceleration)),
      lag_(lag) {
  if (!(lag > 0.0) || deceleration_.size() != position.size() ||
      !(deceleration_.array() > 0.0).all()) {
    throw std::invalid_argument("emulated joints need a lag and decelerations above 0");
  }
}

void EmulatedJoints::command(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) {
  command_ = position;
  command_velocity_ = velocity;
}

void EmulatedJoints::brake() {
  if (!braking_) {
    const double duration =
        (command_velocity_.cwiseAbs().array() / deceleration_.array()).maxCoeff();
    braking_ = Braking{command_, command_velocity_, duration, 0.0};
  }
}

void EmulatedJoints::step(double dt) {
  if (braking_) {
    braking_->time += dt;
    const double t = std::min(braking_->time, braking_->duration);
    const double left = braking_->duration > 0.0 ? 1.0 - t / braking_->duration : 0.0;
    // The integral of a velocity that falls to 0 evenly.
    command_ = braking_->from + braking_->velocity * (0.5 * t * (1.0 + left));
    command_velocity_ = braking_->velocity * left;
  }
  const Eigen::VectorXd before = position_;
  position_ += (1.0 - std::exp(-dt / lag_)) * (command_ - position_);
  velocity_ = (position_ - before) / dt;
}

bool EmulatedJoints::moving() const { return velocity_.cwiseAbs().maxCoeff() > kAtRest; }

}  // namespace handway::device
