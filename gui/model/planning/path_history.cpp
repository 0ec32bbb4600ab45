#include "model/planning/path_history.h"

#include "handway/planning/core/planning_problem.h"

#include <QLocale>
#include <QObject>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace handway::gui {

QString seconds_text(double value) {
  return value < 1.0 ? QStringLiteral("%1 ms").arg(value * 1e3, 0, 'f', 0)
                     : QStringLiteral("%1 s").arg(value, 0, 'f', 2);
}

QString count_text(std::uint64_t value) {
  return QLocale(QLocale::English).toString(static_cast<qulonglong>(value));
}

QString status_text(planning::PlanStatus status) {
  switch (status) {
    case planning::PlanStatus::kSolved:
      return QObject::tr("Path found");
    case planning::PlanStatus::kStartInvalid:
      return QObject::tr("The start is not valid");
    case planning::PlanStatus::kGoalInvalid:
      return QObject::tr("The goal is not valid");
    case planning::PlanStatus::kSamplesSpent:
      return QObject::tr("No path found: all samples are used");
    case planning::PlanStatus::kTimeLimit:
      return QObject::tr("No path found within the time limit");
    case planning::PlanStatus::kCancelled:
      return QObject::tr("Cancelled");
    case planning::PlanStatus::kStalled:
      return QObject::tr("No path found: no more configurations can be sampled");
    case planning::PlanStatus::kInfeasible:
      return QObject::tr("There is no path");
  }
  return {};
}

QString result_line(const planning::PlanResult& result) {
  if (result.solved()) {
    return QObject::tr("Path found in %1, %2 waypoints")
        .arg(seconds_text(result.time_s), count_text(result.path.waypoints.size()));
  }
  return result.reason.empty() ? status_text(result.status) : QString::fromStdString(result.reason);
}

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

double palm_travel(const PathRecord& record) {
  const geometric::RobotModel& model = *record.motion->model;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  double travel = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  bool first = true;
  for (const planning::TrajectoryPoint& point : record.motion->trajectory.points) {
    model.forward_kinematics(point.position, X_BL);
    const Eigen::Vector3d here = X_BL[static_cast<std::size_t>(record.palm)].translation();
    travel += first ? 0.0 : (here - last).norm();
    last = here;
    first = false;
  }
  return travel;
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
  figures.palm_travel = palm_travel(record);
  const MotionCurves& curves = *record.curves;
  if (curves.clearance.empty()) {
    figures.least_clearance = record.run->result.certificate.min_clearance;
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

bool same_path(const planning::Path& a, const planning::Path& b) {
  return std::ranges::equal(a.waypoints, b.waypoints, [](const auto& q, const auto& r) {
    return q.size() == r.size() && q == r;  // of different robots, perhaps
  });
}

namespace {

bool is_of(const PathRecord& known, const PathRecord& record) {
  return record.motion && (known.motion == record.motion ||
                           (known.run && !record.run && known.scene == record.scene &&
                            same_path(known.run->result.path, record.motion->path)));
}

}  // namespace

QString label_of(const QString& origin, const planning::Motion& motion, const QTime& time) {
  return QObject::tr("%1: %2 waypoints, %3 s (%4)")
      .arg(origin)
      .arg(motion.path.waypoints.size())
      .arg(motion.trajectory.duration(), 0, 'f', 1)
      .arg(time.toString(QStringLiteral("HH:mm:ss")));
}

QString label_of(const PlanRun& run, const planning::Motion& motion) {
  return label_of(QObject::tr("%1, seed %2")
                      .arg(QString::fromStdString(run.planner.name))
                      .arg(run.request.seed),
                  motion, run.begun);
}

std::vector<PathRecord>::const_iterator best_of(const std::vector<PathRecord>& records,
                                                PathMerit merit) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto rank = [&](const PathRecord& record) {
    return std::tuple(!record.is_solved(), record.figures ? cost(*record.figures, merit) : kNone,
                      record.run ? record.run->request.seed : 0);
  };
  const auto best = std::ranges::min_element(records, {}, rank);
  return best != records.end() && best->is_solved() ? best : records.end();
}

std::shared_ptr<const planning::Motion> PathHistory::add(PathRecord record) {
  if (record.motion && record.curves && !record.figures) {
    record.figures = figures_of(record);
  }
  const auto known =
      std::ranges::find_if(records_, [&](const PathRecord& other) { return is_of(other, record); });
  if (known != records_.end()) {
    if (!known->motion) {
      known->motion = std::move(record.motion);
      known->label = label_of(*known->run, *known->motion);
    }
    known->curves = std::move(record.curves);
    known->figures = record.figures;
    std::shared_ptr<const planning::Motion> motion = known->motion;
    emit changed();
    return motion;
  }
  if (record.run && record.motion) {
    record.label = label_of(*record.run, *record.motion);
  }
  record.opened_scene = opened_scene_;
  std::shared_ptr<const planning::Motion> motion = record.motion;
  records_.insert(records_.begin(), std::move(record));
  if (records_.size() > kMost) {
    records_.pop_back();
  }
  emit changed();
  return motion;
}

void PathHistory::begin_scene() {
  ++opened_scene_;
  std::erase_if(records_, [this](const PathRecord& record) {
    return record.opened_scene < opened_scene_ - kEarlierScenes;
  });
  emit changed();
}

std::vector<PathRecord> PathHistory::paths() const {
  std::vector<PathRecord> paths;
  std::ranges::copy_if(records_, std::back_inserter(paths), &PathRecord::has_figures);
  return paths;
}

}  // namespace handway::gui
