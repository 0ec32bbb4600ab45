#pragma once

#include "model/planning/plane_chart.h"

#include <QWidget>

#include <optional>

class QComboBox;
class QLabel;
class QStackedWidget;

namespace handway::gui {

class ProjectionPlot;

/// A roadmap in two coordinates to choose: a click on a node asks to see the robot there.
class ProjectionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ProjectionPanel(QWidget* parent = nullptr);

  /// @param charted of what the last call showed too: keeps axes and view.
  void show_roadmap(ChartedRoadmap charted);
  void show_nothing();
  /// Where the robot is.
  void set_robot(const geometric::Configuration& q);

  [[nodiscard]] ProjectionPlot& plot() const { return *plot_; }

 signals:
  void picked(const Eigen::VectorXd& q);
  /// Seen or hidden; what is hidden need not be kept up to date.
  void visibility_changed(bool visible);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void take_theme();
  void name_axes(const planning::HandArmChart& chart);
  void redraw(bool keeps_view);
  void draw_robot();
  void tell(std::optional<int> node);
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
