#include "features/glove/hand_axes.h"

#include "features/glove/coverage_bars.h"
#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>

namespace handway::gui {

HandAxes::HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis)
    : model_(std::move(model)), basis_(std::move(basis)) {
  for (const std::string& joint : basis_.joints) {
    const auto variable = model_ ? model_->find_variable(joint) : std::nullopt;
    if (!variable) {
      variables_.clear();
      return;
    }
    variables_.push_back(*variable);
  }
}

QString HandAxes::name(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free
             ? joint_label(basis_.joints[static_cast<std::size_t>(basis_.free_joints[index].joint)])
             : QString::fromStdString(basis_.directions[index - free].name);
}

double HandAxes::half_side(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free ? basis_.free_joints[index].half_side
                      : basis_.directions[index - free].half_side;
}

Eigen::VectorXd HandAxes::coordinates(const geometric::Configuration& q) const {
  const geometric::Configuration p = geometric::normalised(*model_, q);
  Eigen::VectorXd posture(static_cast<Eigen::Index>(variables_.size()));
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    posture[static_cast<Eigen::Index>(i)] = p[variables_[i]];
  }
  return sampling::project(basis_, posture);
}

Eigen::VectorXd HandAxes::coordinates(const std::vector<std::string>& joints,
                                      const Eigen::VectorXd& posture) const {
  Eigen::VectorXd ordered(static_cast<Eigen::Index>(basis_.joints.size()));
  for (std::size_t i = 0; i < basis_.joints.size(); ++i) {
    const auto found = std::ranges::find(joints, basis_.joints[i]);
    if (found == joints.end()) {
      return {};
    }
    ordered[static_cast<Eigen::Index>(i)] = posture[found - joints.begin()];
  }
  return sampling::project(basis_, ordered);
}

geometric::NamedPosture HandAxes::posture(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd u(dimension());
  for (int axis = 0; axis < dimension(); ++axis) {
    const double side = half_side(axis);
    u[axis] = side > 0.0 ? std::clamp(0.5 * (coordinates[axis] / side + 1.0), 0.0, 1.0) : 0.5;
  }
  const Eigen::VectorXd p = sampling::map_to_posture(basis_, u);
  geometric::NamedPosture posture;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const double lower = model_->lower()[variables_[i]];
    const double upper = model_->upper()[variables_[i]];
    posture.values[basis_.joints[i]] = lower + p[static_cast<Eigen::Index>(i)] * (upper - lower);
  }
  return posture;
}

}  // namespace handway::gui
