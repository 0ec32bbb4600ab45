#include "app/figures/film_data.h"

#include "handway/geometric/io/yaml_element.h"
#include "handway/planning/core/plugin.h"
#include "handway/planning/paths/path_csv.h"

namespace handway::gui {
namespace {

namespace fs = std::filesystem;
using geometric::YamlElement;

constexpr int kMostFrames = 20;

FilmView view_of(const YamlElement& element) {
  if (element.text() == "hand") {
    return FilmView::kHand;
  }
  if (element.text() != "task") {
    element.refuse(element.found(), "task or hand");
  }
  return FilmView::kTask;
}

int frames_of(const YamlElement& element) {
  const double frames = element.number();
  if (frames < 2.0 || frames > kMostFrames || frames != static_cast<int>(frames)) {
    element.refuse(element.found(), "a whole number from 2 to 20");
  }
  return static_cast<int>(frames);
}

FilmRow row_of(const YamlElement& element, const fs::path& folder,
               const planning::Extensions& extensions) {
  element.allow_keys({"label", "scene", "path", "azimuth_deg", "elevation_deg"});
  FilmRow row;
  row.label = element.need("label").text();
  row.scene = planning::load_scene(folder / element.need("scene").text(), extensions).scene;
  if (row.scene->robots.empty()) {
    element.need("scene").refuse("a scene without a robot", "one with a robot");
  }
  row.path = planning::read_path_csv(*row.scene->robots.front().model,
                                     folder / element.need("path").text());
  if (row.path.empty()) {
    element.need("path").refuse("a path without waypoints", "at least one");
  }
  if (const auto azimuth = element.find("azimuth_deg")) {
    row.azimuth = geometric::radians(azimuth->number());
  }
  if (const auto elevation = element.find("elevation_deg")) {
    row.elevation = geometric::radians(elevation->number());
  }
  return row;
}

}  // namespace

FilmData read_film_data(const fs::path& file) {
  const YamlElement top = YamlElement::read(file, "film strips");
  top.allow_keys({"title", "frames", "view", "rows"});
  FilmData data;
  data.title = top.need("title").text();
  data.frames = frames_of(top.need("frames"));
  data.view = view_of(top.need("view"));
  planning::Extensions extensions;
  extensions.load_plugins(planning::plugin_directory());
  for (const YamlElement& row : top.need("rows").items()) {
    data.rows.push_back(row_of(row, file.parent_path(), extensions));
  }
  if (data.rows.empty()) {
    top.need("rows").refuse("an empty list", "at least one row");
  }
  return data;
}

}  // namespace handway::gui
