#include "widgets/plots/projection_plot.h"

#include "widgets/plots/plot_style.h"

#include <QEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPen>
#include <QVBoxLayout>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_item.h>
#include <qwt_plot_magnifier.h>
#include <qwt_plot_panner.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>
#include <qwt_widget_overlay.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kReach = 9.0;    // px, from the pointer to what it means
constexpr double kMargin = 0.12;  // of a range, for the rings around start and goal
constexpr double kLeastRange = 0.02;
constexpr std::size_t kFewNodes = 4000;  // of which each is drawn round

void span_axis(QwtPlot& plot, int axis, double least, double most) {
  const double extra = std::max(kLeastRange - (most - least), 0.0) / 2.0;
  const double margin = kMargin * (most - least) + extra;
  plot.setAxisScale(axis, least - margin, most + margin);
}

}  // namespace

/// Layer that does not change when the robot moves.
class ProjectionPlot::Drawing : public QwtPlotItem {
 public:
  Drawing(const PlaneRoadmap& roadmap, const ProjectionColors& colors)
      : roadmap_(roadmap), colors_(colors) {
    setZ(10.0);
  }

  void draw(QPainter* painter, const QwtScaleMap& x, const QwtScaleMap& y,
            const QRectF& /*canvas*/) const override {
    const auto to_canvas = [&](const QPointF& p) {
      return QPointF(x.transform(p.x()), y.transform(p.y()));
    };
    const bool few = roadmap_.nodes.size() <= kFewNodes;
    painter->setRenderHint(QPainter::Antialiasing, few);
    QColor line = colors_.faint;
    line.setAlpha(110);
    painter->setPen(QPen(line, 0.0));
    for (const auto& [from, to] : roadmap_.edges) {
      painter->drawLine(to_canvas(roadmap_.nodes[static_cast<std::size_t>(from)].place),
                        to_canvas(roadmap_.nodes[static_cast<std::size_t>(to)].place));
    }
    painter->setPen(Qt::NoPen);
    for (const PlaneRoadmap::Node& node : roadmap_.nodes) {
      const QPointF place = to_canvas(node.place);
      if (few) {
        painter->setBrush(node.color);
        painter->drawEllipse(place, 3.0, 3.0);
      } else {
        painter->fillRect(QRectF(place - QPointF(1.5, 1.5), QSizeF(3.0, 3.0)), node.color);
      }
    }
    painter->setRenderHint(QPainter::Antialiasing);
    draw_path(*painter, to_canvas);
    painter->setBrush(Qt::NoBrush);
    for (const auto& [place, color] :
         {std::pair(roadmap_.start, colors_.start), std::pair(roadmap_.goal, colors_.goal)}) {
      painter->setPen(QPen(color, 2.5));
      painter->drawEllipse(to_canvas(place), 7.0, 7.0);
    }
  }

 private:
  template <typename ToCanvas>
  void draw_path(QPainter& painter, const ToCanvas& to_canvas) const {
    QPolygonF line;
    for (const QPointF& point : roadmap_.path) {
      line.append(to_canvas(point));
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colors_.ink, 2.0));
    painter.drawPolyline(line);
  }

  const PlaneRoadmap& roadmap_;
  const ProjectionColors& colors_;
};

/// Mark of the robot over the plot, which is not redrawn when it moves.
class ProjectionPlot::RobotMark : public QwtWidgetOverlay {
 public:
  explicit RobotMark(const ProjectionPlot& plot)
      : QwtWidgetOverlay(plot.canvas()), projection_(plot) {
    setMaskMode(QwtWidgetOverlay::NoMask);
  }

 protected:
  void drawOverlay(QPainter* painter) const override {
    if (!projection_.robot_) {
      return;
    }
    const QPointF place = projection_.place_of(*projection_.robot_);
    painter->setRenderHint(QPainter::Antialiasing);
    for (const auto& [color, width] :
         {std::pair(projection_.colors_.paper, 5.0), std::pair(projection_.colors_.robot, 2.5)}) {
      painter->setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
      painter->drawLine(place - QPointF(7.0, 0.0), place + QPointF(7.0, 0.0));
      painter->drawLine(place - QPointF(0.0, 7.0), place + QPointF(0.0, 7.0));
    }
  }

 private:
  const ProjectionPlot& projection_;
};

ProjectionPlot::ProjectionPlot(QWidget* parent)
    : QWidget(parent),
      plot_(new QwtPlot(this)),
      drawing_(new Drawing(roadmap_, colors_)),
      mark_(nullptr) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  style_plot(*plot_, {}, {});
  drawing_->attach(plot_);
  mark_ = new RobotMark(*this);
  auto* zoom = new QwtPlotMagnifier(plot_->canvas());
  zoom->setMouseButton(Qt::NoButton);
  zoom->setWheelFactor(1.0 / 1.15);
  (new QwtPlotPanner(plot_->canvas()))->setMouseButton(Qt::RightButton);
  plot_->canvas()->setMouseTracking(true);
  plot_->canvas()->setCursor(Qt::CrossCursor);
  plot_->canvas()->installEventFilter(this);
}

ProjectionPlot::~ProjectionPlot() = default;

void ProjectionPlot::set_titles(const QString& x, const QString& y) {
  plot_->setAxisTitle(QwtPlot::xBottom, plot_text(x, 10.0));
  plot_->setAxisTitle(QwtPlot::yLeft, plot_text(y, 10.0));
  set_colors(colors_);
}

void ProjectionPlot::set_roadmap(PlaneRoadmap roadmap, bool keeps_view) {
  roadmap_ = std::move(roadmap);
  hovered_.reset();
  if (keeps_view) {
    plot_->replot();
    mark_->updateOverlay();
  } else {
    show_all();
  }
}

void ProjectionPlot::set_robot(const std::optional<QPointF>& place) {
  robot_ = place;
  mark_->updateOverlay();
}

void ProjectionPlot::show_all() {
  QPolygonF points = roadmap_.path;
  points << roadmap_.start << roadmap_.goal;
  for (const PlaneRoadmap::Node& node : roadmap_.nodes) {
    points << node.place;
  }
  const QRectF all = points.boundingRect();
  span_axis(*plot_, QwtPlot::xBottom, all.left(), all.right());
  span_axis(*plot_, QwtPlot::yLeft, all.top(), all.bottom());
  plot_->replot();
  mark_->updateOverlay();
}

std::optional<int> ProjectionPlot::node_at(const QPoint& place) const {
  std::optional<int> nearest;
  double least = kReach;
  const QwtScaleMap x = plot_->canvasMap(QwtPlot::xBottom);
  const QwtScaleMap y = plot_->canvasMap(QwtPlot::yLeft);
  for (std::size_t i = 0; i < roadmap_.nodes.size(); ++i) {
    const QPointF& node = roadmap_.nodes[i].place;
    const double distance =
        std::hypot(x.transform(node.x()) - place.x(), y.transform(node.y()) - place.y());
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

QPoint ProjectionPlot::place_of(const QPointF& point) const {
  return QPointF(plot_->canvasMap(QwtPlot::xBottom).transform(point.x()),
                 plot_->canvasMap(QwtPlot::yLeft).transform(point.y()))
      .toPoint();
}

QWidget* ProjectionPlot::canvas() const { return plot_->canvas(); }

void ProjectionPlot::hover_at(const QPoint& place) {
  const std::optional<int> node = node_at(place);
  if (node != hovered_) {
    hovered_ = node;
    plot_->canvas()->setCursor(node ? Qt::PointingHandCursor : Qt::CrossCursor);
    if (hover_) {
      hover_(node);
    }
  }
}

bool ProjectionPlot::eventFilter(QObject* watched, QEvent* event) {
  const auto* mouse = dynamic_cast<QMouseEvent*>(event);
  if (event->type() == QEvent::MouseMove) {
    hover_at(mouse->pos());
  } else if (event->type() == QEvent::Leave) {
    hovered_.reset();
    if (hover_) {
      hover_(std::nullopt);
    }
  } else if (event->type() == QEvent::MouseButtonPress && mouse->button() == Qt::LeftButton) {
    press_ = mouse->pos();
  } else if (event->type() == QEvent::MouseButtonRelease && mouse->button() == Qt::LeftButton) {
    const std::optional<int> node = node_at(press_);
    if (node && node == node_at(mouse->pos()) && pick_) {
      pick_(*node);
    }
  } else if (event->type() == QEvent::MouseButtonDblClick && mouse->button() == Qt::LeftButton &&
             !node_at(mouse->pos())) {
    show_all();
  }
  return QWidget::eventFilter(watched, event);
}

void ProjectionPlot::set_colors(const ProjectionColors& colors) {
  colors_ = colors;
  color_plot(*plot_, {colors.paper, colors.faint, colors.grid});
  for (const int axis : {QwtPlot::xBottom, QwtPlot::yLeft}) {
    QwtText title = plot_->axisTitle(axis);
    title.setColor(colors.ink);
    plot_->setAxisTitle(axis, title);
  }
  plot_->replot();
}

}  // namespace handway::gui
