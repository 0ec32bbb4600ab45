#include "widgets/plots/variance_plot.h"

#include "widgets/plots/plot_style.h"

#include <QPen>
#include <QVector>
#include <qwt_column_symbol.h>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_histogram.h>
#include <qwt_plot_marker.h>
#include <qwt_symbol.h>

namespace handway::gui {
namespace {

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
