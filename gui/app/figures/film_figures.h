#pragma once

#include "handway/geometric/math/units.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_problem.h"

#include <QString>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// Direction of the camera of a film strip.
enum class FilmView {
  kTask,  ///< Fixed, with all motions of the robot in view.
  kHand,  ///< Close, and going along with the palm.
};

/// A path as a row of pictures.
struct FilmRow {
  std::string label;
  std::shared_ptr<const geometric::Scene> scene;
  planning::Path path;
  double azimuth = geometric::radians(-62.0);   ///< Camera's, from the path to the task.
  double elevation = geometric::radians(22.0);  ///< Above the horizon.
};

/// Content of a figure of film strips.
struct FilmData {
  std::string title;
  /// Pictures of each path, evenly spread over it, the ends included; 0: one at each waypoint.
  int frames = 6;
  FilmView view = FilmView::kTask;
  std::vector<FilmRow> rows;
};

/// Reads a file as `handway reproduce` writes it: `title`, `frames` (2 to 20, or `waypoints`),
/// `view` (`task` or `hand`) and `rows`, each with `label`, `scene` (a file or the name of one that
/// ships) and `path` (a CSV file), and where the camera is not where it stands else, `azimuth_deg`
/// and `elevation_deg`; files from this file's folder.
/// @throws geometric::InputError with file and line for what is missing or wrong.
[[nodiscard]] FilmData read_film_data(const std::filesystem::path& file);

/// The paths as rows of pictures (Figs. 14 to 17 of the paper), as PNG and SVG. Needs a display.
void write_film_figure(const FilmData& data, const QString& path);

}  // namespace handway::gui
