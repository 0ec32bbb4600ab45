#include "app/figures/film_figures.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/joint_selection.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"
#include "model/document/document.h"
#include "model/playback/path_timeline.h"
#include "view3d/scene_pictures.h"
#include "view3d/viewpoints.h"
#include "widgets/plots/figure_file.h"
#include "widgets/plots/plot_style.h"

#include <QImage>
#include <QSize>

#include <algorithm>
#include <iterator>
#include <vector>

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
  if (element.text() == "waypoints") {
    return 0;
  }
  const double frames = element.number();
  if (frames < 2.0 || frames > kMostFrames || frames != static_cast<int>(frames)) {
    element.refuse(element.found(), "a whole number from 2 to 20, or waypoints");
  }
  return static_cast<int>(frames);
}

FilmRow row_of(const YamlElement& element, const fs::path& folder,
               const planning::PluginManager& plugins) {
  element.allow_keys({"label", "scene", "path", "azimuth_deg", "elevation_deg"});
  FilmRow row;
  row.label = element.need("label").text();
  row.scene = planning::load_scene(folder / element.need("scene").text(), plugins).scene;
  if (row.scene->robots.empty()) {
    element.need("scene").refuse("a scene without a robot", "one with a robot");
  }
  row.path =
      planning::read_path(*row.scene->robots.front().model, folder / element.need("path").text());
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
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  for (const YamlElement& row : top.need("rows").items()) {
    data.rows.push_back(row_of(row, file.parent_path(), plugins));
    if (data.frames == 0 && data.rows.back().path.waypoints.size() > kMostFrames) {
      row.need("path").refuse("a path of more than 20 waypoints", "at most 20, one a picture");
    }
  }
  if (data.rows.empty()) {
    top.need("rows").refuse("an empty list", "at least one row");
  }
  return data;
}

namespace {

constexpr double kHandDistance = 0.95;  // m
constexpr double kAroundPath = 0.17;    // m, so that fingers are in the picture

OrbitCamera camera_of(const FilmRow& row) {
  OrbitCamera camera;
  OrbitCamera::Placement placement;
  placement.azimuth = task_azimuth(*row.scene) + row.azimuth;
  placement.elevation = row.elevation;
  placement.distance = kHandDistance;
  camera.set_placement(placement);
  return camera;
}

// Corners around the palm's way, where the task is.
std::vector<Eigen::Vector3d> corners_around(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& point : points) {
    for (int corner = 0; corner < 8; ++corner) {
      corners.push_back(point + kAroundPath * Eigen::Vector3d((corner & 1) != 0 ? 1.0 : -1.0,
                                                              (corner & 2) != 0 ? 1.0 : -1.0,
                                                              (corner & 4) != 0 ? 1.0 : -1.0));
    }
  }
  return corners;
}

std::vector<QImage> pictures_of(const FilmRow& row, int frames, FilmView view) {
  const geometric::RobotInstance& robot = row.scene->robots.front();
  const PathTimeline timeline(*robot.model, row.path);
  const auto joints = geometric::JointSelection::of_groups(*robot.model);
  const std::vector<Eigen::Vector3d> palm =
      palm_path(robot, timeline,
                geometric::HandStructure::of(*robot.model, joints.arm, joints.hand).palm)
          .points;
  ScenePictures pictures(row.scene);
  OrbitCamera camera = camera_of(row);
  if (view == FilmView::kTask) {
    camera.fit(corners_around(palm),
               static_cast<double>(kStripFrame.width()) / kStripFrame.height());
  }
  std::vector<QImage> strip;
  const int count = frames > 0 ? frames : static_cast<int>(row.path.waypoints.size());
  for (int frame = 0; frame < count; ++frame) {
    const double fraction = frames > 0 ? static_cast<double>(frame) / (frames - 1)
                                       : timeline.fraction_of(static_cast<std::size_t>(frame));
    if (view == FilmView::kHand) {
      OrbitCamera::Placement placement = camera.placement();
      placement.target =
          palm[static_cast<std::size_t>(fraction * static_cast<double>(palm.size() - 1))];
      camera.set_placement(placement);
    }
    strip.push_back(pictures.picture(timeline.at(fraction), camera, kStripScale * kStripFrame));
  }
  return strip;
}

}  // namespace

void write_film_figure(const FilmData& data, const QString& path) {
  std::vector<Strip> strips;
  std::ranges::transform(data.rows, std::back_inserter(strips), [&](const FilmRow& row) {
    return Strip{QString::fromStdString(row.label), pictures_of(row, data.frames, data.view)};
  });
  write_figure(path, QString::fromStdString(data.title), strips_size(strips), draw_strips(strips));
}

}  // namespace handway::gui
