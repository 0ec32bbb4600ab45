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

/// Input of the pictures of a hand basis: `basis.yaml` of a folder, as `handway pca --plots` writes
/// it, and the hand that it names.
struct FigureData {
  std::shared_ptr<const geometric::RobotModel> hand;
  sampling::PmdBasis basis;

  /// The hand's configuration for a posture of the basis (normalised joints).
  [[nodiscard]] geometric::Configuration configuration(const Eigen::VectorXd& posture) const;
};

/// @throws geometric::InputError with file and line for what is missing or wrong.
[[nodiscard]] FigureData read_figure_data(const std::filesystem::path& folder);

/// The hand along each of the first two directions, from one side of the box to the other
/// (Fig. 8). Needs a display.
void write_direction_figure(const FigureData& data, const QString& path);

/// The hand over a grid of the first two directions (Fig. 9). Needs a display.
void write_grid_figure(const FigureData& data, const QString& path);

}  // namespace handway::gui
