#include "widgets/plots/cursor_plot.h"

#include "widgets/plots/figure_file.h"
#include "widgets/plots/plot_style.h"

#include <QMouseEvent>
#include <QPen>
#include <QResizeEvent>
#include <QVBoxLayout>
#include <QVector>
#include <QWheelEvent>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kScaleWidth = 46;  // px, so that plots don't jump with their numbers
constexpr double kWidth = 1.6;
constexpr double kLegendSize = 8.5;
constexpr double kMargin = 0.06;  // above and below the curves, of their range
constexpr double kLimitOpacity = 0.45;
constexpr double kStepOfWheel = 0.85;
constexpr double kDegreesOfStep = 120.0;  // QWheelEvent counts eighths of degrees
constexpr double kShortest = 0.02;        // s in sight
const QSize kPrintSize{760, 380};

void add_curve(QwtPlot& plot, const QString& title, const QPen& pen, const QVector<QPointF>& points,
               bool in_legend) {
  auto* curve = new QwtPlotCurve(QwtText(title, QwtText::PlainText));
  curve->setPen(pen);
  curve->setSamples(points);
  curve->setRenderHint(QwtPlotItem::RenderAntialiased);
  curve->setItemAttribute(QwtPlotItem::Legend, in_legend);
  curve->setLegendAttribute(QwtPlotCurve::LegendShowLine);
  curve->attach(&plot);
}

QVector<QPointF> points_of(const std::vector<double>& times, const std::vector<double>& values) {
  QVector<QPointF> points;
  points.reserve(static_cast<int>(times.size()));
  for (std::size_t i = 0; i < std::min(times.size(), values.size()); ++i) {
    points.append({times[i], values[i]});
  }
  return points;
}

QPen faint(const QColor& color) {
  QColor paler = color;
  paler.setAlphaF(kLimitOpacity);
  return {paler, 1.0, Qt::DotLine};
}

}  // namespace

CursorPlot::CursorPlot(QWidget* parent) : QWidget(parent), plot_(new QwtPlot) {
  style_plot(*plot_, {}, {});
  plot_->setAxisMaxMajor(QwtPlot::yLeft, 5);
  plot_->axisScaleDraw(QwtPlot::yLeft)->setMinimumExtent(kScaleWidth);
  plot_->canvas()->installEventFilter(this);
  plot_->canvas()->setCursor(Qt::ArrowCursor);
  line_ = new QWidget(plot_->canvas());
  line_->setAttribute(Qt::WA_TransparentForMouseEvents);
  line_->setAutoFillBackground(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumHeight(90);
}

void CursorPlot::set_colors(const PlotColors& colors, const QColor& cursor) {
  colors_ = colors;
  color_plot(*plot_, colors);
  line_->setStyleSheet(QStringLiteral("background: %1").arg(cursor.name()));
  rebuild();
}

void CursorPlot::set_titles(const QString& x, const QString& y) {
  plot_->setAxisTitle(QwtPlot::xBottom, plot_text(x, 9.0));
  plot_->setAxisTitle(QwtPlot::yLeft, plot_text(y, 9.0));
  color_plot(*plot_, colors_);
}

void CursorPlot::set_lines(std::vector<double> times, std::vector<PlotLine> lines) {
  if (times != times_) {
    x_.reset();
  }
  y_.reset();
  times_ = std::move(times);
  lines_ = std::move(lines);
  rebuild();
}

void CursorPlot::set_marks(std::vector<double> times) {
  marks_ = std::move(times);
  rebuild();
}

void CursorPlot::set_cursor(double time) {
  time_ = time;
  place_cursor();
}

void CursorPlot::show_all() {
  x_.reset();
  y_.reset();
  rebuild();
}

std::pair<double, double> CursorPlot::span() const {
  const Range x = range(QwtPlot::xBottom);
  return {x.least, x.most};
}

QWidget* CursorPlot::canvas() const { return plot_->canvas(); }

QPoint CursorPlot::place_of(double time) const {
  const int x = qRound(plot_->canvasMap(QwtPlot::xBottom).transform(time));
  return {x, plot_->canvas()->height() / 2};
}

CursorPlot::Range CursorPlot::range(int axis) const {
  if (axis == QwtPlot::xBottom) {
    const Range all{0.0, times_.empty() ? 1.0 : std::max(times_.back(), kShortest)};
    return x_.value_or(all);
  }
  if (y_) {
    return *y_;
  }
  Range all{0.0, 0.0};
  bool first = true;
  for (const PlotLine& line : lines_) {
    for (const double value : line.values) {
      all.least = first ? value : std::min(all.least, value);
      all.most = first ? value : std::max(all.most, value);
      first = false;
    }
  }
  const double size = all.most - all.least;
  const double margin = size > 1e-9 ? kMargin * size : 1.0;
  return {all.least - margin, all.most + margin};
}

void CursorPlot::set_range(int axis, Range range) {
  (axis == QwtPlot::xBottom ? x_ : y_) = range;
  rebuild();
}

void CursorPlot::fill(QwtPlot& plot, bool for_print) const {
  for (const int axis : {QwtPlot::xBottom, QwtPlot::yLeft}) {
    const Range shown = range(axis);
    plot.setAxisScale(axis, shown.least, shown.most);
  }
  const Range y = range(QwtPlot::yLeft);
  const double tick = 0.035 * (y.most - y.least);
  for (const double mark : marks_) {
    add_curve(plot, {}, QPen(for_print ? PlotColors{}.ink : colors_.ink, 1.0),
              {{mark, y.most}, {mark, y.most - tick}}, false);
  }
  for (const PlotLine& line : lines_) {
    for (const double limit : line.limits) {
      add_curve(plot, {}, faint(line.color), {{0.0, limit}, {times_.back(), limit}}, false);
    }
  }
  for (const PlotLine& line : lines_) {
    add_curve(plot, line.title,
              QPen(line.color, kWidth, line.dashed ? Qt::DashLine : Qt::SolidLine),
              points_of(times_, line.values), true);
  }
}

void CursorPlot::rebuild() {
  plot_->detachItems(QwtPlotItem::Rtti_PlotCurve, true);
  fill(*plot_, false);
  plot_->replot();
  place_cursor();
}

void CursorPlot::place_cursor() {
  const Range x = range(QwtPlot::xBottom);
  line_->setVisible(!times_.empty() && time_ >= x.least - 1e-9 && time_ <= x.most + 1e-9);
  const int at = std::min(place_of(time_).x(), plot_->canvas()->width() - 2);
  line_->setGeometry(at, 0, 2, plot_->canvas()->height());
}

void CursorPlot::zoom(int axis, double factor, int pixel) {
  const double middle = plot_->invTransform(axis, pixel);
  const Range old = range(axis);
  Range wanted{middle - (middle - old.least) * factor, middle + (old.most - middle) * factor};
  if (axis == QwtPlot::xBottom) {
    const double end = times_.empty() ? 1.0 : times_.back();
    wanted = {std::max(wanted.least, 0.0), std::min(wanted.most, end)};
    if (wanted.most - wanted.least < kShortest) {
      return;
    }
  }
  set_range(axis, wanted);
}

void CursorPlot::move_by(const QPoint& pixels) {
  const Range x = range(QwtPlot::xBottom);
  const Range y = range(QwtPlot::yLeft);
  const double dx = -(x.most - x.least) * pixels.x() / plot_->canvas()->width();
  const double dy = (y.most - y.least) * pixels.y() / plot_->canvas()->height();
  const double end = times_.empty() ? 1.0 : times_.back();
  const double shift = std::clamp(dx, -x.least, std::max(end - x.most, -x.least));
  x_ = Range{x.least + shift, x.most + shift};
  y_ = Range{y.least + dy, y.most + dy};
  rebuild();
}

bool CursorPlot::eventFilter(QObject* watched, QEvent* event) {
  const auto scrub_to = [this](const QPoint& place) {
    if (scrub_ && !times_.empty()) {
      scrub_(std::clamp(plot_->invTransform(QwtPlot::xBottom, place.x()), 0.0, times_.back()));
    }
  };
  switch (event->type()) {
    case QEvent::Resize:
      place_cursor();
      break;
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      last_ = mouse->pos();
      if (mouse->button() == Qt::LeftButton) {
        scrub_to(last_);
      }
      return true;
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if ((mouse->buttons() & Qt::LeftButton) != 0) {
        scrub_to(mouse->pos());
      } else if ((mouse->buttons() & (Qt::MiddleButton | Qt::RightButton)) != 0) {
        move_by(mouse->pos() - last_);
      }
      last_ = mouse->pos();
      return true;
    }
    case QEvent::MouseButtonDblClick:
      show_all();
      return true;
    case QEvent::Wheel: {
      const auto* wheel = static_cast<QWheelEvent*>(event);
      const bool values = (wheel->modifiers() & Qt::ControlModifier) != 0;
      const double factor = std::pow(kStepOfWheel, wheel->angleDelta().y() / kDegreesOfStep);
      zoom(values ? QwtPlot::yLeft : QwtPlot::xBottom, factor,
           qRound(values ? wheel->position().y() : wheel->position().x()));
      return true;
    }
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

void CursorPlot::write(const QString& file, const QString& title) const {
  QwtPlot printed;
  style_plot(printed, plot_->axisTitle(QwtPlot::xBottom).text(),
             plot_->axisTitle(QwtPlot::yLeft).text());
  auto* legend = new QwtLegend;
  legend->setFont(plot_font(kLegendSize));
  printed.insertLegend(legend, QwtPlot::RightLegend);
  fill(printed, true);
  write_picture(file, title, kPrintSize, [&printed](QPainter& painter, const QSize& size) {
    printed.replot();
    draw_plot(painter, size, printed);
  });
}

TimePlot::TimePlot(const QString& x_title, const QString& y_title, QWidget* parent)
    : QWidget(parent), plot_(new QwtPlot) {
  style_plot(*plot_, x_title, y_title);
  plot_->setAxisMaxMajor(QwtPlot::yLeft, 4);
  plot_->axisScaleDraw(QwtPlot::yLeft)->setMinimumExtent(kScaleWidth);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
}

int TimePlot::add_curve(const QString& title, const QColor& color, bool dashed) {
  auto* curve = new QwtPlotCurve(QwtText(title, QwtText::PlainText));
  curve->setPen(color, kWidth, dashed ? Qt::DashLine : Qt::SolidLine);
  curve->setRenderHint(QwtPlotItem::RenderAntialiased);
  curve->attach(plot_);
  curves_.push_back(curve);
  return static_cast<int>(curves_.size()) - 1;
}

void TimePlot::show_legend() {
  auto* legend = new QwtLegend;
  legend->setFont(plot_font(kLegendSize));
  plot_->insertLegend(legend, QwtPlot::TopLegend);
}

void TimePlot::set_colors(const PlotColors& colors) { color_plot(*plot_, colors); }

void TimePlot::clear() {
  for (QwtPlotCurve* curve : curves_) {
    delete curve;
  }
  curves_.clear();
  plot_->replot();
}

void TimePlot::set_curve(int index, const std::vector<double>& times,
                         const std::vector<double>& values) {
  QVector<QPointF> points;
  for (std::size_t i = 0; i < times.size(); ++i) {
    points.append({times[i], values[i]});
  }
  curves_[static_cast<std::size_t>(index)]->setSamples(points);
}

void TimePlot::refresh() { plot_->replot(); }

}  // namespace handway::gui
