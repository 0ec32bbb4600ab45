#include "model/planning/path_history.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace handway::gui {
namespace {

bool same_path(const planning::Path& a, const planning::Path& b) {
  return std::ranges::equal(a.waypoints, b.waypoints);
}

bool is_of(const PathRecord& known, const PathRecord& record) {
  return record.motion && (known.motion == record.motion ||
                           (known.run && !record.run && known.scene == record.scene &&
                            same_path(known.run->result.path, record.motion->path)));
}

}  // namespace

QString label_of(const QString& way, const planning::Motion& motion, const QTime& time) {
  return QObject::tr("%1: %2 waypoints, %3 s (%4)")
      .arg(way)
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
  std::shared_ptr<const planning::Motion> motion = record.motion;
  records_.insert(records_.begin(), std::move(record));
  if (records_.size() > kMost) {
    records_.pop_back();
  }
  emit changed();
  return motion;
}

std::vector<PathRecord> PathHistory::paths() const {
  std::vector<PathRecord> paths;
  std::ranges::copy_if(records_, std::back_inserter(paths), &PathRecord::has_figures);
  return paths;
}

}  // namespace handway::gui
