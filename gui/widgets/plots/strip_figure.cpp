#include "widgets/plots/strip_figure.h"

#include "widgets/plots/plot_style.h"

#include <QPainter>
#include <QPen>

namespace handway::gui {
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
