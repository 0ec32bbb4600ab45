#include "widgets/plots/figure_file.h"

#include "handway/geometric/io/replace_file.h"

#include <QBuffer>
#include <QImage>
#include <QPainter>
#include <QPalette>
#include <QPen>
#include <QSvgGenerator>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_plot_renderer.h>
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

namespace {

constexpr double kScreenDpi = 96.0;
constexpr double kPrintDpi = 300.0;
constexpr double kInch = 0.0254;  // m

QByteArray png(const QSize& size, const DrawFigure& draw) {
  const double scale = kPrintDpi / kScreenDpi;
  QImage image((QSizeF(size) * scale).toSize(), QImage::Format_RGB32);
  image.fill(Qt::white);
  image.setDotsPerMeterX(qRound(kScreenDpi / kInch));  // letters as on the screen, scaled below
  image.setDotsPerMeterY(qRound(kScreenDpi / kInch));
  QPainter painter(&image);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  painter.scale(scale, scale);
  draw(painter, size);
  painter.end();
  image.setDotsPerMeterX(qRound(kPrintDpi / kInch));
  image.setDotsPerMeterY(qRound(kPrintDpi / kInch));
  QByteArray bytes;
  QBuffer buffer(&bytes);
  image.save(&buffer, "PNG");
  return bytes;
}

QByteArray svg(const QSize& size, const QString& title, const DrawFigure& draw) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(size);
  generator.setViewBox(QRect(QPoint(0, 0), size));
  generator.setResolution(qRound(kScreenDpi));
  generator.setTitle(title.toHtmlEscaped());  // Qt writes it as it is
  QPainter painter(&generator);
  painter.fillRect(QRect(QPoint(0, 0), size), Qt::white);
  draw(painter, size);
  painter.end();
  return bytes;
}

}  // namespace

void write_figure(const QString& path, const QString& title, const QSize& size,
                  const DrawFigure& draw) {
  write_bytes(path + QStringLiteral(".png"), png(size, draw));
  write_bytes(path + QStringLiteral(".svg"), svg(size, title, draw));
}

QByteArray picture_bytes(const QString& file, const QString& title, const QSize& size,
                         const DrawFigure& draw) {
  return file.endsWith(QStringLiteral(".svg"), Qt::CaseInsensitive) ? svg(size, title, draw)
                                                                    : png(size, draw);
}

void write_bytes(const QString& file, const QByteArray& bytes) {
  geometric::replace_file(file.toStdString(),
                          {bytes.constData(), static_cast<std::size_t>(bytes.size())});
}

void write_picture(const QString& file, const QString& title, const QSize& size,
                   const DrawFigure& draw) {
  write_bytes(file, picture_bytes(file, title, size, draw));
}

void draw_plot(QPainter& painter, const QSize& size, QwtPlot& plot) {
  QwtPlotRenderer renderer;
  renderer.setDiscardFlag(QwtPlotRenderer::DiscardBackground);
  renderer.setLayoutFlag(QwtPlotRenderer::FrameWithScales, false);
  renderer.render(&plot, &painter, QRectF(QPointF(0, 0), size).adjusted(8, 8, -8, -8));
}

namespace {

constexpr int kGap = 4;
constexpr int kHeading = 22;  // above a strip, for its label

int heading_of(const Strip& strip) { return strip.label.isEmpty() ? 0 : kHeading; }

}  // namespace

QSize strips_size(const std::vector<Strip>& strips, const QSize& frame) {
  int height = kGap;
  for (const Strip& strip : strips) {
    height += heading_of(strip) + frame.height() + kGap;
  }
  const int pictures = strips.empty() ? 0 : static_cast<int>(strips.front().pictures.size());
  return {pictures * (frame.width() + kGap) + kGap, height};
}

DrawFigure draw_strips(const std::vector<Strip>& strips, const QSize& frame) {
  return [&strips, frame](QPainter& painter, const QSize& size) {
    int top = strips.empty() || !strips.front().label.isEmpty() ? 0 : kGap;
    for (const Strip& strip : strips) {
      painter.setFont(plot_font(9.0, true));
      painter.setPen(kPlotInk);
      painter.drawText(QRect(kGap, top, size.width() - 2 * kGap, heading_of(strip)),
                       Qt::AlignLeft | Qt::AlignVCenter, strip.label);
      top += heading_of(strip);
      int left = kGap;
      for (const QImage& picture : strip.pictures) {
        const QRect cell(QPoint(left, top), frame);
        painter.drawImage(cell, picture);
        painter.setPen(QPen(kPlotGrid, 0.75));
        painter.drawRect(cell);
        left += frame.width() + kGap;
      }
      top += frame.height() + kGap;
    }
  };
}

}  // namespace handway::gui
