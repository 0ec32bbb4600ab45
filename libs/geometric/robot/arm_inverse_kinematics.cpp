#include "handway/geometric/robot/arm_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace handway::geometric {
namespace {

bool is_of_arm(const RobotModel& model, const JointIndices& arm, int link) {
  return std::ranges::count(arm, model.mimic_mapping(link).variable) > 0;
}

[[noreturn]] void refuse(const RobotModel& model, int link) {
  throw InputError({"inverse kinematics of " + model.name(), "link " + model.link(link).name,
                    "no arm joint that moves it", "at least one", ""});
}

// Largest slide of the joint, m; 0 if it turns or is fixed.
double travel(const RobotModel& model, int link) {
  const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
  if (model.joint(link).type != JointType::kPrismatic || drive.variable < 0) {
    return 0.0;
  }
  const JointLimits& limits = model.variable(drive.variable).limits;
  return std::max(std::abs(drive.multiplier * limits.lower + drive.offset),
                  std::abs(drive.multiplier * limits.upper + drive.offset));
}

}  // namespace

std::unique_ptr<InverseKinematics> closed_form_inverse_kinematics(
    const std::shared_ptr<const RobotModel>& model, int tip_link, const JointIndices& arm) {
  try {
    auto ik = make_spherical_wrist_inverse_kinematics(model, model->link(tip_link).name);
    JointIndices sorted = arm;
    std::ranges::sort(sorted);
    return ik->variables() == sorted ? std::move(ik) : nullptr;
  } catch (const InputError&) {  // another kind of arm
    return nullptr;
  }
}

std::unique_ptr<NumericInverseKinematics> iterative_inverse_kinematics(
    const std::shared_ptr<const RobotModel>& model, int tip_link, const JointIndices& arm,
    const NumericIkOptions& options) {
  std::vector<std::string> joints;
  for (const int v : chain_variables(*model, tip_link)) {
    if (std::ranges::count(arm, v) > 0) {
      joints.push_back(model->variable(v).name);
    }
  }
  if (joints.empty()) {
    refuse(*model, tip_link);
  }
  return std::make_unique<NumericInverseKinematics>(model, model->link(tip_link).name, joints,
                                                    options);
}

std::unique_ptr<InverseKinematics> make_arm_inverse_kinematics(
    const std::shared_ptr<const RobotModel>& model, int tip_link, const JointIndices& arm,
    const NumericIkOptions& options) {
  auto closed_form = closed_form_inverse_kinematics(model, tip_link, arm);
  return closed_form ? std::move(closed_form)
                     : iterative_inverse_kinematics(model, tip_link, arm, options);
}

ReachBall reach_ball(const RobotModel& model, int link, const JointIndices& arm,
                     const Configuration& q) {
  int first = 0;  // the arm's joint on the chain that is nearest to the root
  for (int i = link; i > 0; i = model.parent(i)) {
    first = is_of_arm(model, arm, i) ? i : first;
  }
  if (first == 0) {
    refuse(model, link);
  }
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  ReachBall ball;
  ball.centre =
      X_BL[static_cast<std::size_t>(model.parent(first))] * model.joint(first).X_PJ.translation();
  ball.radius = travel(model, first);
  for (int i = link; i != first; i = model.parent(i)) {
    ball.radius += model.joint(i).X_PJ.translation().norm() + travel(model, i);
  }
  return ball;
}

}  // namespace handway::geometric
