#include "model/devices/arm_leader.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/tx90_inverse_kinematics.h"

#include <exception>

namespace handway::gui {
namespace {

using geometric::InverseKinematics;
using geometric::RobotModel;

// In closed form if the arm allows it, else by iteration from where it is, briefly.
std::unique_ptr<InverseKinematics> make_kinematics(const std::shared_ptr<const RobotModel>& model,
                                                   int tool) {
  constexpr int kIterations = 30;
  const std::string& link = model->link(tool).name;
  try {
    return geometric::make_tx90_inverse_kinematics(model, link);
  } catch (const geometric::InputError&) {
    geometric::NumericIkOptions options;
    options.max_iterations = kIterations;
    options.max_restarts = 0;
    return std::make_unique<geometric::NumericInverseKinematics>(
        model, link, std::vector<std::string>{}, options);
  }
}

}  // namespace

ArmLeader::ArmLeader(QObject* parent) : QObject(parent), problem_(tr("There is no robot")) {}

void ArmLeader::set_robot(const std::shared_ptr<const RobotModel>& model,
                          const std::vector<int>& arm, const geometric::Configuration& q) {
  set_clutch(false);
  ik_.reset();
  joints_.clear();
  q_ = q;
  if (!model || arm.empty()) {
    problem_ = model ? tr("The robot has no arm") : tr("There is no robot");
    return;
  }
  try {
    ik_ = make_kinematics(model, model->variable_link(arm.back()));
    for (const int variable : ik_->variables()) {
      joints_.push_back(model->variable(variable).name);
    }
    problem_.clear();
  } catch (const std::exception& error) {
    problem_ = QString::fromUtf8(error.what());
  }
}

void ArmLeader::set_settings(const device::ToolFollowerSettings& settings) {
  settings_ = settings;
  if (closed_) {
    take_hold();
  }
}

std::optional<Eigen::Vector3d> ArmLeader::tool_position() const {
  if (!ik_) {
    return std::nullopt;
  }
  return device::ToolFollower(ik_, q_).tool_pose().translation();
}

void ArmLeader::take_hold() {
  follower_.emplace(ik_, q_, settings_);
  follower_->engage();
}

void ArmLeader::set_clutch(bool closed) {
  closed = closed && ik_;
  if (closed == closed_) {
    return;
  }
  closed_ = closed;
  if (closed) {
    take_hold();
  } else {
    follower_.reset();
  }
  emit clutch_changed(closed);
}

void ArmLeader::take(const device::TrackerSample& sample) {
  if (!follower_) {
    return;
  }
  const device::FollowStep step = follower_->update(sample);
  if (!follower_->engaged()) {
    set_clutch(false);
  } else {
    geometric::NamedPosture posture;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      posture.values[joints_[j]] = step.q[ik_->variables()[j]];
    }
    emit wanted(posture);
  }
  emit followed(step);
}

}  // namespace handway::gui
