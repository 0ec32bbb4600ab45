#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <QString>

#include <memory>
#include <vector>

namespace handway::gui {

/// The axes of a PMD basis on the hand of a robot: postures to coordinates and back.
class HandAxes {
 public:
  HandAxes() = default;
  /// Empty if the robot lacks a joint of the basis.
  HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis);

  [[nodiscard]] bool empty() const { return variables_.empty(); }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }
  [[nodiscard]] int dimension() const { return empty() ? 0 : basis_.dimension(); }
  [[nodiscard]] QString name(int axis) const;
  [[nodiscard]] double half_side(int axis) const;

  /// @param q shape [variable_count]. @returns shape [dimension].
  [[nodiscard]] Eigen::VectorXd coordinates(const geometric::Configuration& q) const;
  /// @param posture normalised joints named `joints`. @returns shape [dimension]; empty if
  /// one of the basis' joints is not among them.
  [[nodiscard]] Eigen::VectorXd coordinates(const std::vector<std::string>& joints,
                                            const Eigen::VectorXd& posture) const;
  /// The hand's posture at coordinates within the box.
  [[nodiscard]] geometric::NamedPosture posture(const Eigen::VectorXd& coordinates) const;

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
  sampling::PmdBasis basis_;
  std::vector<int> variables_;  ///< Of the basis' joints.
};

}  // namespace handway::gui
