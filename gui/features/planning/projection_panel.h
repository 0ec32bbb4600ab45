#pragma once

#include "handway/planning/queries/hand_arm_chart.h"
#include "model/document/prepared_problem.h"
#include "model/planning/palm_roadmap.h"

#include <QObject>
#include <QStringList>
#include <QWidget>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QStackedWidget;

namespace handway::gui {

class ProjectionPlot;

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

/// Computes the chart, which takes a moment with many nodes. @param roadmap may be null.
/// @param path waypoints, close together; may be empty.
[[nodiscard]] ChartedRoadmap charted(PreparedProblem::Problem problem, SharedRoadmap roadmap,
                                     const std::vector<geometric::Configuration>& path);

/// The axes' names on screen.
[[nodiscard]] QStringList titles_of(const planning::HandArmChart& chart);

/// A roadmap in two coordinates to choose: a click on a node asks to see the robot there.
class ProjectionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ProjectionPanel(QWidget* parent = nullptr);

  /// @param charted of what the last call showed too: keeps axes and view.
  void show_roadmap(ChartedRoadmap charted);
  void show_nothing();
  /// Sets the configuration of the robot.
  void set_robot(const geometric::Configuration& q);

  [[nodiscard]] ProjectionPlot& plot() const { return *plot_; }

 signals:
  void picked(const Eigen::VectorXd& q);
  /// Emitted when the tool is shown or hidden; hidden content need not be up to date.
  void visibility_changed(bool visible);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void name_axes(const planning::HandArmChart& chart);
  void redraw(bool keeps_view);
  void draw_robot();
  void notify(std::optional<int> node);
  [[nodiscard]] QPointF in_plane(const Eigen::VectorXd& coordinates) const;

  QComboBox* x_;
  QComboBox* y_;
  QStackedWidget* pages_;
  ProjectionPlot* plot_;
  QLabel* note_;
  ChartedRoadmap charted_;
  geometric::Configuration q_;
};

}  // namespace handway::gui
