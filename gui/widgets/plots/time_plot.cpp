#include "widgets/plots/time_plot.h"

#include "widgets/plots/plot_style.h"

#include <QPen>
#include <QVBoxLayout>
#include <QVector>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_scale_draw.h>

namespace handway::gui {
namespace {

constexpr int kScaleWidth = 46;  // px, the same for all
constexpr double kLegendSize = 8.5;
constexpr double kWidth = 1.6;

}  // namespace

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
  auto* curve = new QwtPlotCurve(title);
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
