#include "model/planning/path_figures.h"

#include "handway/planning/core/planning_problem.h"
#include "model/planning/path_history.h"

#include <QObject>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace handway::gui {
namespace {

double mean(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

std::optional<planning::DistanceAlong> distance_along(const std::vector<double>& values) {
  if (values.empty()) {
    return std::nullopt;
  }
  return planning::DistanceAlong{mean(values), *std::ranges::max_element(values)};
}

double palm_way(const PathRecord& record) {
  const geometric::RobotModel& model = *record.motion->model;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  double way = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  bool first = true;
  for (const planning::TrajectoryPoint& point : record.motion->trajectory.points) {
    model.forward_kinematics(point.position, X_BL);
    const Eigen::Vector3d here = X_BL[static_cast<std::size_t>(record.palm)].translation();
    way += first ? 0.0 : (here - last).norm();
    last = here;
    first = false;
  }
  return way;
}

double human_cost(const PathFigures& figures) {
  return figures.to_recorded   ? figures.to_recorded->mean
         : figures.to_subspace ? figures.to_subspace->mean
                               : 0.0;
}

}  // namespace

PathFigures figures_of(const PathRecord& record) {
  const planning::Motion& motion = *record.motion;
  PathFigures figures;
  figures.duration = motion.trajectory.duration();
  figures.waypoints = static_cast<int>(motion.path.waypoints.size());
  figures.length = length_of(*motion.model, motion.path);
  figures.turning = turning_of(*motion.model, motion.path);
  figures.palm_way = palm_way(record);
  const MotionCurves& curves = *record.curves;
  if (curves.clearance.empty()) {
    figures.least_clearance = record.run->result.certificate.min_clearance_mm * 1e-3;
  } else {
    figures.least_clearance = *std::ranges::min_element(curves.clearance);
    figures.mean_clearance = mean(curves.clearance);
  }
  figures.to_subspace = distance_along(curves.to_subspace);
  figures.to_recorded = distance_along(curves.to_recorded);
  return figures;
}

double length_of(const geometric::RobotModel& model, const planning::Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    length += planning::normalised_distance(model, path.waypoints[i - 1], path.waypoints[i]);
  }
  return length;
}

double turning_of(const geometric::RobotModel& model, const planning::Path& path) {
  double turning = 0.0;
  double before = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    const double here =
        planning::normalised_distance(model, path.waypoints[i - 1], path.waypoints[i]);
    if (before > 0.0 && here > 0.0) {
      const double across =
          planning::normalised_distance(model, path.waypoints[i - 2], path.waypoints[i]);
      const double cosine =
          (across * across - before * before - here * here) / (2.0 * before * here);
      turning += std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    before = here;
  }
  return turning;
}

double cost(const PathFigures& figures, PathMerit merit) {
  switch (merit) {
    case PathMerit::kShort:
      return figures.length;
    case PathMerit::kQuick:
      return figures.duration;
    case PathMerit::kSmooth:
      return figures.turning;
    case PathMerit::kHuman:
      return human_cost(figures);
    case PathMerit::kClear:
      return -figures.least_clearance;
  }
  return 0.0;
}

QString superlative(PathMerit merit) {
  switch (merit) {
    case PathMerit::kShort:
      return QObject::tr("shortest");
    case PathMerit::kQuick:
      return QObject::tr("quickest");
    case PathMerit::kSmooth:
      return QObject::tr("smoothest");
    case PathMerit::kHuman:
      return QObject::tr("most human");
    case PathMerit::kClear:
      return QObject::tr("safest");
  }
  return {};
}

}  // namespace handway::gui
