#pragma once

#include <QColor>
#include <QPointF>
#include <QPolygonF>
#include <QString>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class QwtPlot;

namespace handway::gui {

/// A roadmap in two of its coordinates.
struct PlaneRoadmap {
  struct Node {
    QPointF place;
    QColor color;
  };
  std::vector<Node> nodes;
  std::vector<std::pair<int, int>> edges;  ///< Indices of nodes.
  QPolygonF path;                          ///< Empty: none.
  QPointF start;
  QPointF goal;
};

/// Colours of a projection.
struct ProjectionColors {
  QColor paper;
  QColor ink;
  QColor faint;  ///< Edges, numbers.
  QColor grid;
  QColor start;
  QColor goal;
  QColor robot;
};

/// A roadmap as a scatter plot: dots for its nodes, lines for edges and path, rings for start and
/// goal, a cross where the robot is. A click picks a node; the wheel zooms, the right button
/// moves, a double click shows all.
class ProjectionPlot : public QWidget {
 public:
  explicit ProjectionPlot(QWidget* parent = nullptr);
  ~ProjectionPlot() override;

  void set_colors(const ProjectionColors& colors);
  void set_titles(const QString& x, const QString& y);
  /// Sets the roadmap. @param keeps_view keeps the visible range; otherwise shows all.
  void set_roadmap(PlaneRoadmap roadmap, bool keeps_view);
  /// Sets the position of the robot; nothing: no cross.
  void set_robot(const std::optional<QPointF>& place);
  void show_all();

  /// Sets the function that is called with the clicked node.
  void on_pick(std::function<void(int)> pick) { pick_ = std::move(pick); }
  /// Sets the function that is called with the node at the pointer; nothing: beside all.
  void on_hover(std::function<void(std::optional<int>)> hover) { hover_ = std::move(hover); }

  /// The node at a place in the canvas.
  [[nodiscard]] std::optional<int> node_at(const QPoint& place) const;
  /// Returns the position of a point in the canvas.
  [[nodiscard]] QPoint place_of(const QPointF& point) const;
  [[nodiscard]] const PlaneRoadmap& roadmap() const { return roadmap_; }
  [[nodiscard]] QWidget* canvas() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  class Drawing;
  class RobotMark;

  void hover_at(const QPoint& place);

  QwtPlot* plot_;
  Drawing* drawing_;
  RobotMark* mark_;
  ProjectionColors colors_;
  PlaneRoadmap roadmap_;
  std::optional<QPointF> robot_;
  std::optional<int> hovered_;
  QPoint press_;
  std::function<void(int)> pick_;
  std::function<void(std::optional<int>)> hover_;
};

}  // namespace handway::gui
