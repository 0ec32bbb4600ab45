#pragma once

#include "handway/planning/core/plugin.h"
#include "reproduced_figure.h"

#include <filesystem>
#include <set>
#include <vector>

namespace handway::tools {

/// Figures of paths: 14, the hand along a path without principal motion directions and
/// with them, and 17, the paths of the four problems.
[[nodiscard]] const std::set<int>& film_figures();

/// Plans the paths of those of `figures` that are films on the scenes that ship, each with seed 1,
/// and draws them as film strips: `figure_N.png` and `.svg`, made of `figure_N.yaml` and paths as
/// CSV in the folder `figure_N`.
/// @param time_limit_s of each plan; a row without a path says so.
/// @throws InputError if a file can't be written or a scene not be read.
[[nodiscard]] std::vector<ReproducedFigure> reproduce_films(const std::set<int>& figures,
                                                            const planning::Extensions& extensions,
                                                            double time_limit_s,
                                                            const std::filesystem::path& folder);

}  // namespace handway::tools
