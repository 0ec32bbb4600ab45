#pragma once

#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <filesystem>

namespace handway::tools {

/// Writes `postures.csv` (rad), `basis.yaml` and `variance.csv` to a folder, which is made if it
/// isn't there, and has draw_figures() draw their figures there.
/// @param postures rad, shape [samples, joints of the basis].
/// @param shares of the variance, shape [directions].
/// @throws InputError if a file can't be written, and as draw_figures().
void write_basis_plots(const std::filesystem::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares);

}  // namespace handway::tools
