#pragma once

#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <filesystem>

namespace handway::tools {

/// Runs the program `handway-figures` beside this one to draw the figures of a folder or file:
/// directly on a display, under xvfb-run without one.
/// @throws InputError if the program or xvfb-run is missing or fails.
void draw_figures(const std::filesystem::path& source);

/// Writes `postures.csv` (rad), `basis.yaml` and `variance.csv` to a folder, which is created if
/// missing, and calls draw_figures() for it.
/// @param postures rad, shape [samples, joints of the basis].
/// @param shares of the variance, shape [directions].
/// @throws InputError if a file can't be written, and as draw_figures().
void write_basis_plots(const std::filesystem::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares);

}  // namespace handway::tools
