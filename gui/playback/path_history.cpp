#include "playback/path_history.h"

#include "handway/planning/core/planning_problem.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

}  // namespace

PathFigures figures_of(const PathRecord& record) {
  const planning::Motion& motion = *record.motion;
  PathFigures figures;
  figures.duration = motion.trajectory.duration();
  figures.waypoints = static_cast<int>(motion.path.waypoints.size());
  for (std::size_t i = 1; i < motion.path.waypoints.size(); ++i) {
    figures.length += planning::normalised_distance(*motion.model, motion.path.waypoints[i - 1],
                                                    motion.path.waypoints[i]);
  }
  figures.palm_way = palm_way(record);
  const MotionCurves& curves = *record.curves;
  figures.least_clearance = *std::ranges::min_element(curves.clearance);
  figures.mean_clearance = mean(curves.clearance);
  figures.to_subspace = distance_along(curves.to_subspace);
  figures.to_recorded = distance_along(curves.to_recorded);
  return figures;
}

void PathHistory::add(PathRecord record) {
  const auto known = std::ranges::find(records_, record.motion, &PathRecord::motion);
  if (known != records_.end()) {
    known->curves = std::move(record.curves);
    emit changed();
    return;
  }
  records_.insert(records_.begin(), std::move(record));
  if (records_.size() > kMost) {
    records_.pop_back();
  }
  emit changed();
}

}  // namespace handway::gui
