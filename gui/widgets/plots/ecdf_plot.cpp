#include "widgets/plots/ecdf_plot.h"

#include <QVBoxLayout>
#include <QVector>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_scale_engine.h>
#include <qwt_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kShortest = 1e-5;  // s; what is shorter is drawn here
constexpr double kWidth = 1.8;
constexpr double kLegendSize = 8.5;
// Okabe and Ito's colours, that all eyes distinguish.
constexpr std::array<QRgb, 7> kColors = {0xff0072b2, 0xffd55e00, 0xff009e73, 0xffcc79a7,
                                         0xffe69f00, 0xff56b4e9, 0xff000000};

QVector<QPointF> steps_of(const EcdfCurve& curve, double last) {
  std::vector<double> times = curve.times;
  std::sort(times.begin(), times.end());
  QVector<QPointF> points;
  double share = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = std::max(kShortest, times[i]);
    points.append({time, share});
    share = 100.0 * static_cast<double>(i + 1) / curve.runs;
    points.append({time, share});
  }
  points.append({last, share});
  return points;
}

}  // namespace

EcdfPlot::EcdfPlot(QWidget* parent) : QWidget(parent), plot_(new QwtPlot) {
  style_plot(*plot_, QStringLiteral("Planning time [s]"), QStringLiteral("Runs with a path (%)"));
  plot_->setAxisScaleEngine(QwtPlot::xBottom, new QwtLogScaleEngine);
  plot_->setAxisScale(QwtPlot::xBottom, 0.001, 10.0);
  plot_->setAxisScale(QwtPlot::yLeft, 0.0, 102.0, 25.0);
  auto* legend = new QwtLegend;
  legend->setFont(plot_font(kLegendSize));
  plot_->insertLegend(legend, QwtPlot::TopLegend);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
}

void EcdfPlot::set_colors(const PlotColors& colors, std::function<QColor(const QColor&)> on_paper) {
  on_paper_ = std::move(on_paper);
  color_plot(*plot_, colors);
}

void EcdfPlot::set_curves(const std::vector<EcdfCurve>& curves) {
  plot_->detachItems(QwtPlotItem::Rtti_PlotCurve);
  double least = 0.1;
  double most = 0.1;
  for (const EcdfCurve& curve : curves) {
    for (const double time : curve.times) {
      least = std::min(least, std::max(kShortest, time));
      most = std::max(most, time);
    }
  }
  const double first = std::pow(10.0, std::floor(std::log10(least)));
  const double last = std::pow(10.0, std::ceil(std::log10(most)));
  plot_->setAxisScale(QwtPlot::xBottom, first, last > first ? last : 10.0 * first);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    auto* line = new QwtPlotCurve(QwtText(curves[i].title, QwtText::PlainText));
    const QColor color = QColor::fromRgb(kColors[i % kColors.size()]);
    line->setPen(on_paper_ ? on_paper_(color) : color, kWidth);
    line->setRenderHint(QwtPlotItem::RenderAntialiased);
    line->setLegendAttribute(QwtPlotCurve::LegendShowLine);
    line->setSamples(steps_of(curves[i], last));
    line->attach(plot_);
  }
  plot_->replot();
}

}  // namespace handway::gui
