#pragma once

#include "reproduced_figure.h"

#include <filesystem>
#include <set>
#include <vector>

namespace handway::tools {

/// Figures of hand postures: 7, correlations between joints; 8 and 9, the hand along the first
/// two principal motion directions and over both; 10, the variance that they cover.
[[nodiscard]] const std::set<int>& posture_figures();

/// Analyses the recording that ships and, where HANDWAY_REFERENCE_DIR names the folder of the
/// published files, the recordings of people in it, mapped by the paper's Table 1, and draws those
/// of `figures` that are figures of postures to `postures/RECORDING`. The numbers of 7 and 10
/// stand in `figure_7.csv` and `figure_10.csv` beside it.
/// @throws InputError if a file can't be written or the recording that ships not be read.
[[nodiscard]] std::vector<ReproducedFigure> reproduce_postures(const std::set<int>& figures,
                                                               const std::filesystem::path& folder);

}  // namespace handway::tools
