#pragma once

#include "handway/planning/queries/hand_arm_chart.h"
#include "model/document/prepared_problem.h"
#include "model/planning/palm_roadmap.h"

#include <QStringList>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::gui {

/// A problem's chart, with what it refers to.
struct ProblemChart {
  PreparedProblem::Problem problem;
  planning::HandArmChart chart{*problem};
};

/// A roadmap and a path in the coordinates of a chart: a column a configuration, a row an axis.
struct ChartedRoadmap {
  std::shared_ptr<const ProblemChart> chart;
  SharedRoadmap roadmap;
  Eigen::MatrixXd nodes;
  Eigen::MatrixXd path;
  Eigen::VectorXd start;
  Eigen::VectorXd goal;
};

/// Takes a moment with many nodes.
/// @param roadmap may be null. @param path waypoints, close together; may be empty.
[[nodiscard]] ChartedRoadmap charted(PreparedProblem::Problem problem, SharedRoadmap roadmap,
                                     const std::vector<geometric::Configuration>& path);

/// The axes' names on screen.
[[nodiscard]] QStringList titles_of(const planning::HandArmChart& chart);

}  // namespace handway::gui
