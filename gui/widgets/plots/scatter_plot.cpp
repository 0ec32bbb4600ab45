#include "widgets/plots/scatter_plot.h"

#include "widgets/plots/plot_style.h"

#include <QPen>
#include <QVector>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_symbol.h>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr Eigen::Index kMostDots = 2500;
constexpr double kMargin = 0.06;  // of the range

void span_axis(QwtPlot& plot, int axis, const Eigen::VectorXd& values) {
  const double least = values.minCoeff();
  const double most = values.maxCoeff();
  const double margin = std::max(kMargin * (most - least), 0.5);
  plot.setAxisScale(axis, least - margin, most + margin);
  plot.setAxisMaxMajor(axis, 6);
}

}  // namespace

double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd u = x.array() - x.mean();
  const Eigen::VectorXd v = y.array() - y.mean();
  const double lengths = u.norm() * v.norm();
  return lengths > 0.0 ? u.dot(v) / lengths : 0.0;
}

std::unique_ptr<QwtPlot> make_scatter_plot(const PlotVariable& x, const PlotVariable& y) {
  auto plot = std::make_unique<QwtPlot>();
  style_plot(*plot, x.title, y.title);
  const QString r = QString::number(correlation(x.values, y.values), 'f', 2);
  plot->setTitle(
      plot_text(QStringLiteral("<i>r</i> = %1").arg(QString(r).replace('-', QChar(0x2212))), 9.5));
  const Eigen::Index count = std::min(kMostDots, x.values.size());
  QVector<QPointF> points;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = i * x.values.size() / count;
    points.append({x.values[row], y.values[row]});
  }
  auto* const dots = new QwtPlotCurve;
  dots->setStyle(QwtPlotCurve::NoCurve);
  QColor fill = kPlotBlue;
  fill.setAlpha(90);
  dots->setSymbol(new QwtSymbol(QwtSymbol::Ellipse, fill, QPen(Qt::NoPen), QSize(3, 3)));
  dots->setRenderHint(QwtPlotItem::RenderAntialiased);
  dots->setSamples(points);
  dots->attach(plot.get());
  span_axis(*plot, QwtPlot::xBottom, x.values);
  span_axis(*plot, QwtPlot::yLeft, y.values);
  plot->replot();
  return plot;
}

}  // namespace handway::gui
