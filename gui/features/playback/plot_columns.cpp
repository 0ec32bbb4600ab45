#include "features/playback/plot_columns.h"

#include "handway/geometric/math/units.h"
#include "model/playback/motion_analysis.h"

#include <QObject>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace handway::gui {
namespace {

constexpr const char* kClearance = "clearance_mm";
constexpr const char* kToSubspace = "distance_to_pmds";
constexpr const char* kToRecorded = "distance_to_recorded";

double unit(const geometric::RobotModel& model, int variable) {
  return slides(model, variable) ? geometric::millimetres(1.0) : geometric::degrees(1.0);
}

}  // namespace

bool is_of_joints(PlotQuantity quantity) {
  return quantity != PlotQuantity::kClearance && quantity != PlotQuantity::kUnlikeness;
}

bool slides(const geometric::RobotModel& model, int variable) {
  return model.variable(variable).type == geometric::JointType::kPrismatic;
}

QString unit_of(PlotQuantity quantity, bool slides) {
  const QString unit = slides ? QStringLiteral("mm") : QStringLiteral("°");
  switch (quantity) {
    case PlotQuantity::kPosition:
      return unit;
    case PlotQuantity::kVelocity:
      return unit + QStringLiteral("/s");
    case PlotQuantity::kAcceleration:
      return unit + QStringLiteral("/s²");
    case PlotQuantity::kClearance:
      return QStringLiteral("mm");
    case PlotQuantity::kUnlikeness:
      break;
  }
  return {};
}

QString axis_title(PlotQuantity quantity, bool slides) {
  const auto with_unit = [&](const QString& name) {
    return QStringLiteral("%1, %2").arg(name, unit_of(quantity, slides));
  };
  switch (quantity) {
    case PlotQuantity::kPosition:
      return with_unit(QObject::tr("position"));
    case PlotQuantity::kVelocity:
      return with_unit(QObject::tr("velocity"));
    case PlotQuantity::kAcceleration:
      return with_unit(QObject::tr("acceleration"));
    case PlotQuantity::kClearance:
      return with_unit(QObject::tr("clearance"));
    case PlotQuantity::kUnlikeness:
      break;
  }
  return QObject::tr("distance");
}

std::vector<double> joint_values(const planning::Motion& motion, int variable,
                                 PlotQuantity quantity) {
  const double scale = unit(*motion.model, variable);
  std::vector<double> values;
  values.reserve(motion.trajectory.points.size());
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    const Eigen::VectorXd& all = quantity == PlotQuantity::kPosition   ? point.position
                                 : quantity == PlotQuantity::kVelocity ? point.velocity
                                                                       : point.acceleration;
    values.push_back(scale * all[variable]);
  }
  return values;
}

std::vector<PlotColumn> motion_columns(const MotionCurves& curves, PlotQuantity quantity) {
  std::vector<PlotColumn> columns;
  if (quantity == PlotQuantity::kUnlikeness) {
    columns = {{kToSubspace, curves.to_subspace}, {kToRecorded, curves.to_recorded}};
  } else {
    columns.push_back({kClearance, {}});
    std::ranges::transform(curves.clearance, std::back_inserter(columns.back().values),
                           geometric::millimetres);
  }
  std::erase_if(columns, [](const PlotColumn& column) { return column.values.empty(); });
  return columns;
}

QString title_of(const PlotColumn& column) {
  return column.name == kToSubspace   ? QObject::tr("to the PMD subspace")
         : column.name == kToRecorded ? QObject::tr("to the nearest recorded posture")
                                      : QObject::tr("Clearance");
}

std::vector<double> joint_limits(const planning::Motion& motion, int variable,
                                 PlotQuantity quantity) {
  const double scale = unit(*motion.model, variable);
  if (quantity == PlotQuantity::kPosition) {
    return motion.model->is_continuous(variable)
               ? std::vector<double>{}
               : std::vector<double>{scale * motion.model->lower()[variable],
                                     scale * motion.model->upper()[variable]};
  }
  const Eigen::VectorXd& most =
      quantity == PlotQuantity::kVelocity ? motion.limits.velocity : motion.limits.acceleration;
  return {-scale * most[variable], scale * most[variable]};
}

std::string csv_of(const std::vector<double>& times, const std::vector<PlotColumn>& columns) {
  std::string text = "time_s";
  for (const PlotColumn& column : columns) {
    text += "," + column.name;
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    text += fmt::format("\n{:.6g}", times[i]);
    for (const PlotColumn& column : columns) {
      text += fmt::format(",{:.9g}", column.values[i] + 0.0);
    }
  }
  return text + "\n";
}

}  // namespace handway::gui
