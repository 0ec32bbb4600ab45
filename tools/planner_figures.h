#pragma once

#include "handway/planning/extensions/plugin.h"
#include "reproduce_report.h"

#include <filesystem>
#include <set>
#include <vector>

namespace handway::tools {

/// Figures of the paper that show how it samples and searches: 11, a box in a subspace of the hand;
/// 12, samples of hand and arm; 13, the search range of a roadmap under construction.
[[nodiscard]] const std::set<int>& planner_figures();

/// Makes those of `figures`, with their numbers in `figure_N.csv`. Figs. 12 and 13 are on the scene
/// of the two cans.
/// @throws InputError if a file can't be written, or a recording or scene can't be read.
[[nodiscard]] std::vector<ReproducedFigure> reproduce_planner_figures(
    const std::set<int>& figures, const planning::PluginManager& plugins,
    const std::filesystem::path& folder);

}  // namespace handway::tools
