#include "app/figures/film_figures.h"

#include "model/document/joint_groups.h"
#include "model/playback/palm_path.h"
#include "model/playback/path_timeline.h"
#include "view3d/scene_extent.h"
#include "view3d/scene_pictures.h"
#include "widgets/plots/figure_file.h"
#include "widgets/plots/strip_figure.h"

#include <QImage>

#include <algorithm>
#include <iterator>
#include <vector>

namespace handway::gui {
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
  const std::vector<Eigen::Vector3d> palm =
      palm_path(robot, timeline, palm_link(*robot.model, joint_groups(*robot.model, nullptr)))
          .points;
  ScenePictures pictures(row.scene);
  OrbitCamera camera = camera_of(row);
  if (view == FilmView::kTask) {
    camera.fit(corners_around(palm),
               static_cast<double>(kStripFrame.width()) / kStripFrame.height());
  }
  std::vector<QImage> strip;
  for (int frame = 0; frame < frames; ++frame) {
    const double fraction = static_cast<double>(frame) / (frames - 1);
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
