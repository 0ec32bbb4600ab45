#pragma once

#include <QSize>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// Of the window, px.
constexpr QSize kUsualSize{1440, 900};

/// What the command line asks of the workbench.
struct Options {
  std::filesystem::path scene;       ///< Empty: start with an empty window.
  std::filesystem::path screenshot;  ///< Empty: stay open.
  bool view_only = false;            ///< The picture shows the 3-D view alone, of that size.
  /// Nothing: as last time; at first, and for pictures, kUsualSize.
  std::optional<QSize> size;
  bool play = false;    ///< Plan at once, then play in a loop.
  std::string planner;  ///< Empty: the scene's.
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

}  // namespace handway::gui
