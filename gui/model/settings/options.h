#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/robot_description.h"

#include <QSize>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// Size of the window, px.
constexpr QSize kUsualSize{1440, 900};

/// Options of the workbench on the command line.
struct Options {
  std::filesystem::path scene;       ///< Empty: start with an empty window.
  geometric::XacroArguments xacro;   ///< Arguments of a robot file in xacro; empty: ask for them.
  std::filesystem::path screenshot;  ///< Empty: stay open.
  bool view_only = false;            ///< The picture shows the 3-D view alone, of that size.
  /// Window size; empty: the last one; at first, and for pictures, kUsualSize.
  std::optional<QSize> size;
  std::filesystem::path path;  ///< File of a path to show at once; empty: none.
  bool play = false;           ///< Plan at once, unless there is a path, then play in a loop.
  std::string planner;         ///< Empty: the scene's.
  std::optional<std::uint64_t> seed;
  std::vector<std::pair<std::string, std::string>> settings;
  std::string glove;               ///< Device to connect to at once; empty: none.
  std::string glove_page;          ///< Page of the glove's panel to open; empty: the first.
  double glove_time = 3.0;         ///< To listen to glove and tracker before a screenshot, s.
  std::string tracker;             ///< Wrist tracker to connect to at once; empty: none.
  std::filesystem::path campaign;  ///< Campaign or run database to open at once; empty: none.
  std::string theme;               ///< "light" or "dark"; empty: as last time.
  std::optional<int> text_size;    ///< Percent; nothing: as in the preferences.
};

/// Colours of the 3-D view that go with the window's theme.
struct ViewColors {
  geometric::Color sky{0.78F, 0.83F, 0.89F, 1.0F};     ///< Backdrop, top.
  geometric::Color ground{0.96F, 0.97F, 0.98F, 1.0F};  ///< Backdrop, bottom.
  geometric::Color grid{0.42F, 0.48F, 0.56F, 1.0F};
  geometric::Color text{0.20F, 0.24F, 0.30F, 1.0F};
};

/// Colours of start and goal, in the view and in the panels.
inline constexpr geometric::Color kStartColor{0.16F, 0.62F, 0.44F, 1.0F};
inline constexpr geometric::Color kGoalColor{0.92F, 0.52F, 0.16F, 1.0F};

/// Colours of the ends of a search that found no path, from the start and from the goal.
inline constexpr geometric::Color kFromStartColor{0.13F, 0.45F, 0.86F, 1.0F};
inline constexpr geometric::Color kFromGoalColor{0.62F, 0.25F, 0.74F, 1.0F};

/// A path that gets better, while it does.
inline constexpr geometric::Color kOptimizedColor{0.10F, 0.55F, 0.95F, 1.0F};

}  // namespace handway::gui
