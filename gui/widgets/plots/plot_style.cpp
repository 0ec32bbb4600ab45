#include "widgets/plots/plot_style.h"

#include <QPalette>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_widget.h>
#include <qwt_text.h>

namespace handway::gui {
namespace {

constexpr double kTitleSize = 10.0;
constexpr double kLabelSize = 9.0;

// Numbers with a minus sign as long as a plus sign.
class NumberScale : public QwtScaleDraw {
 public:
  [[nodiscard]] QwtText label(double value) const override {
    return QwtScaleDraw::label(value).text().replace('-', QChar(0x2212));
  }
};

void style_axis(QwtPlot& plot, int axis, const QString& title) {
  plot.setAxisTitle(axis, plot_text(title, kTitleSize));
  plot.setAxisFont(axis, plot_font(kLabelSize));
  plot.setAxisMaxMinor(axis, 0);
  plot.setAxisScaleDraw(axis, new NumberScale);
  QwtScaleDraw& draw = *plot.axisScaleDraw(axis);
  draw.setTickLength(QwtScaleDiv::MajorTick, 4.0);
  draw.setSpacing(3.0);
  plot.axisWidget(axis)->setMargin(0);
  plot.axisWidget(axis)->setSpacing(4);
}

}  // namespace

QFont plot_font(double size, bool bold) {
  QFont font(QStringLiteral("DejaVu Sans"));
  font.setPointSizeF(size);
  font.setBold(bold);
  return font;
}

QwtText plot_text(const QString& text, double size, bool bold) {
  QwtText result(text, QwtText::PlainText);
  result.setFont(plot_font(size, bold));
  result.setColor(kPlotInk);
  return result;
}

void style_plot(QwtPlot& plot, const QString& x_title, const QString& y_title) {
  plot.setAutoFillBackground(true);
  auto* const canvas = new QwtPlotCanvas(&plot);
  canvas->setFrameStyle(QFrame::NoFrame);
  plot.setCanvas(canvas);
  plot.plotLayout()->setAlignCanvasToScales(true);
  style_axis(plot, QwtPlot::xBottom, x_title);
  style_axis(plot, QwtPlot::yLeft, y_title);
  auto* const grid = new QwtPlotGrid;
  grid->attach(&plot);
  color_plot(plot, {});
}

// In print the palette counts. On screen it would not do: the application's style sheet puts back
// the palettes from before it was applied.
void color_plot(QwtPlot& plot, const PlotColors& colors) {
  QPalette palette;
  palette.setColor(QPalette::Window, colors.paper);
  palette.setColor(QPalette::WindowText, colors.ink);
  palette.setColor(QPalette::Text, colors.ink);
  plot.setPalette(palette);
  plot.canvas()->setPalette(palette);
  plot.setStyleSheet(QStringLiteral("QwtPlot, QwtPlotCanvas { background: %1 } "
                                    "QwtScaleWidget, QwtTextLabel { color: %2 }")
                         .arg(colors.paper.name(), colors.ink.name()));
  for (const int axis : {QwtPlot::xBottom, QwtPlot::yLeft}) {
    QwtText title = plot.axisTitle(axis);
    title.setColor(colors.ink);
    plot.setAxisTitle(axis, title);
  }
  for (QwtPlotItem* item : plot.itemList(QwtPlotItem::Rtti_PlotGrid)) {
    static_cast<QwtPlotGrid*>(item)->setMajorPen(colors.grid, 0.75);
  }
}

}  // namespace handway::gui
