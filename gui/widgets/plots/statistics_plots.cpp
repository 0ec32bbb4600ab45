#include "widgets/plots/statistics_plots.h"

#include "widgets/plots/plot_style.h"

#include <QPen>
#include <QVector>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_histogram.h>
#include <qwt_plot_marker.h>
#include <qwt_symbol.h>
#include <qwt_text.h>

#include <algorithm>

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

constexpr double kBarWidth = 0.6;
constexpr int kLabelled = 4;  // directions whose sum is written down

void add_bars(QwtPlot& plot, const Eigen::VectorXd& shares) {
  QVector<QwtIntervalSample> bars;
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    const auto place = static_cast<double>(k + 1);
    bars.append({100.0 * shares[k], place - kBarWidth / 2, place + kBarWidth / 2});
  }
  auto* const histogram = new QwtPlotHistogram(QStringLiteral("each direction"));
  histogram->setSamples(bars);
  histogram->setPen(QPen(Qt::NoPen));
  QColor fill = kPlotBlue;
  fill.setAlpha(70);
  histogram->setBrush(fill);
  histogram->attach(&plot);
}

void add_sums(QwtPlot& plot, const Eigen::VectorXd& shares) {
  QVector<QPointF> points;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    sum += 100.0 * shares[k];
    points.append({static_cast<double>(k + 1), sum});
    if (k < kLabelled && k + 1 < shares.size()) {
      auto* const label = new QwtPlotMarker;
      label->setValue(points.back());
      label->setLabel(plot_text(QStringLiteral("%1 %").arg(sum, 0, 'f', 1), 8.5));
      label->setLabelAlignment(Qt::AlignBottom | Qt::AlignRight);
      label->setSpacing(4);
      label->attach(&plot);
    }
  }
  auto* const curve = new QwtPlotCurve(QStringLiteral("all up to it"));
  curve->setPen(kPlotBlue, 1.5);
  curve->setRenderHint(QwtPlotItem::RenderAntialiased);
  curve->setSymbol(new QwtSymbol(QwtSymbol::Ellipse, Qt::white, QPen(kPlotBlue, 1.5), QSize(6, 6)));
  curve->setLegendAttribute(QwtPlotCurve::LegendShowLine);
  curve->setSamples(points);
  curve->attach(&plot);
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
  QwtText title = plot_text({}, 9.5);
  title.setText(QStringLiteral("<i>r</i> = %1").arg(QString(r).replace('-', QChar(0x2212))),
                QwtText::RichText);
  plot->setTitle(title);
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

std::unique_ptr<QwtPlot> make_variance_plot(const Eigen::VectorXd& shares) {
  auto plot = std::make_unique<QwtPlot>();
  style_plot(*plot, QStringLiteral("Number of principal motion directions"),
             QStringLiteral("Variance covered (%)"));
  add_bars(*plot, shares);
  add_sums(*plot, shares);
  plot->setAxisScale(QwtPlot::xBottom, 0.5, static_cast<double>(shares.size()) + 0.5);
  QList<double> ticks;
  for (Eigen::Index k = 1; k <= shares.size(); ++k) {
    ticks.append(static_cast<double>(k));
  }
  QwtScaleDiv scale(0.5, static_cast<double>(shares.size()) + 0.5);
  scale.setTicks(QwtScaleDiv::MajorTick, ticks);
  plot->setAxisScaleDiv(QwtPlot::xBottom, scale);
  plot->setAxisScale(QwtPlot::yLeft, 0.0, 102.0, 20.0);
  auto* const legend = new QwtLegend;
  legend->setFont(plot_font(9.0));
  plot->insertLegend(legend, QwtPlot::TopLegend);
  plot->replot();
  return plot;
}

}  // namespace handway::gui
