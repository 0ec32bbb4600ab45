#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <QString>

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// Input of the figures of a hand basis: `postures.csv` (a column for each joint of the basis,
/// rad), `basis.yaml` and `variance.csv` (column `share`) of one folder, as `handway pca --plots`
/// writes them, and the hand that the basis names.
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

/// Six pairs of joints as scatter plots (Fig. 7): the paper's for a hand with its joints,
/// else those that correlate most. Needs two joints that move.
void write_correlation_figure(const FigureData& data, const QString& path);

/// Cumulative variance by the number of directions (Fig. 10).
void write_variance_figure(const FigureData& data, const QString& path);

/// The hand along each of the first two directions, from one side of the box to the other
/// (Fig. 8). Needs a display.
void write_direction_figure(const FigureData& data, const QString& path);

/// The hand over a grid of the first two directions (Fig. 9). Needs a display.
void write_grid_figure(const FigureData& data, const QString& path);

}  // namespace handway::gui
