#pragma once

#include "handway/planning/extensions/plugin.h"
#include "reproduce_report.h"

#include <filesystem>
#include <set>
#include <vector>

namespace handway::tools {

/// Figures of the paper that show robots: 14, the hand along a path without principal motion
/// directions and with them; 15, a path and its execution side by side; 16, start and goal of the
/// four problems; 17, their paths.
[[nodiscard]] const std::set<int>& film_figures();

/// Makes those of `figures` on the scenes that ship, planned by the paper's planners with seed 1:
/// `figure_N.png` and `.svg`, made of `figure_N.yaml` and of paths as CSV in the folder `figure_N`,
/// with what is measured on them in `figure_N.csv`. Fig. 15 runs the path on emulated devices.
/// @param time_limit_s of each plan; a row without a path has a note.
/// @throws InputError if a file can't be written or a scene can't be read.
[[nodiscard]] std::vector<ReproducedFigure> reproduce_films(const std::set<int>& figures,
                                                            const planning::PluginManager& plugins,
                                                            double time_limit_s,
                                                            const std::filesystem::path& folder);

}  // namespace handway::tools
