#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// What the figures of a hand basis show: `postures.csv` (a column for each joint of the basis,
/// rad), `basis.yaml` and `variance.csv` (column `share`) of one folder, as `handway pca --plots`
/// leaves them, and the hand that the basis names.
struct FigureData {
  std::shared_ptr<const geometric::RobotModel> hand;
  sampling::PmdBasis basis;
  Eigen::MatrixXd postures;  ///< rad, shape [samples, joints].
  Eigen::VectorXd shares;    ///< In [0, 1], shape [directions].

  /// The hand's configuration for a posture of the basis (normalised joints).
  [[nodiscard]] geometric::Configuration configuration(const Eigen::VectorXd& posture) const;
};

/// @throws geometric::InputError with file and line for what is missing or wrong.
[[nodiscard]] FigureData read_figure_data(const std::filesystem::path& folder);

}  // namespace handway::gui
