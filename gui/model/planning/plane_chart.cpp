#include "model/planning/plane_chart.h"

#include <QObject>

#include <utility>

namespace handway::gui {
namespace {

Eigen::MatrixXd coordinates(const planning::HandArmChart& chart, std::size_t count,
                            const auto& configuration) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(chart.axes().size()),
                         static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    result.col(static_cast<Eigen::Index>(i)) = chart.at(configuration(i));
  }
  return result;
}

}  // namespace

ChartedRoadmap charted(PreparedProblem::Problem problem, SharedRoadmap roadmap,
                       const std::vector<geometric::Configuration>& path) {
  ChartedRoadmap result;
  result.chart = std::make_shared<ProblemChart>(ProblemChart{std::move(problem)});
  result.roadmap = std::move(roadmap);
  const planning::HandArmChart& chart = result.chart->chart;
  if (result.roadmap) {
    const auto& nodes = result.roadmap->roadmap.nodes;
    result.nodes = coordinates(
        chart, nodes.size(), [&](std::size_t i) -> const auto& { return nodes[i].q; });
  }
  result.path = coordinates(
      chart, path.size(), [&](std::size_t i) -> const auto& { return path[i]; });
  result.start = chart.at(result.chart->problem->start);
  result.goal = chart.at(result.chart->problem->goal);
  return result;
}

QStringList titles_of(const planning::HandArmChart& chart) {
  using Kind = planning::HandArmChart::Axis::Kind;
  QStringList titles;
  int direction = 0;
  for (const auto& [kind, name] : chart.axes()) {
    switch (kind) {
      case Kind::kArmWay:
        titles << QObject::tr("Arm's way, start to goal");
        break;
      case Kind::kArmDistance:
        titles << QObject::tr("Beside the arm's way");
        break;
      case Kind::kFreeJoint:
        titles << QObject::tr("Joint %1").arg(QString::fromStdString(name));
        break;
      case Kind::kDirection:
        titles << QObject::tr("PMD %1").arg(++direction);
        break;
      case Kind::kHandDistance:
        titles << QObject::tr("Off the PMD subspace");
        break;
    }
  }
  return titles;
}

}  // namespace handway::gui
