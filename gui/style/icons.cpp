#include "style/icons.h"

#include "style/theme.h"

#include <QFile>
#include <QPainter>
#include <QPixmap>
#include <QSvgRenderer>

namespace handway::gui {
namespace {

// Drawings are black; black becomes `color`.
QPixmap render(const QByteArray& drawing, const QColor& color, int size) {
  QByteArray colored = drawing;
  colored.replace("#000000", color.name(QColor::HexRgb).toLatin1());
  QSvgRenderer renderer(colored);
  QPixmap pixmap(size, size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setOpacity(color.alphaF());
  renderer.render(&painter);
  return pixmap;
}

QByteArray read_drawing(const QString& name) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void add_sizes(QIcon& icon, const QByteArray& drawing, const QColor& color, QIcon::Mode mode,
               QIcon::State state) {
  for (const int size : {16, 20, 24, 32, 48}) {
    icon.addPixmap(render(drawing, color, size), mode, state);
  }
}

}  // namespace

QIcon icon(const QString& name) {
  const QByteArray drawing = read_drawing(name);
  const ThemeColors colors = colors_of(current_theme());
  QColor rest = colors.text;
  rest.setAlphaF(0.82);
  QColor faint = colors.muted;
  faint.setAlphaF(0.45);
  QIcon result;
  add_sizes(result, drawing, rest, QIcon::Normal, QIcon::Off);
  add_sizes(result, drawing, colors.accent, QIcon::Normal, QIcon::On);
  add_sizes(result, drawing, faint, QIcon::Disabled, QIcon::Off);
  add_sizes(result, drawing, faint, QIcon::Disabled, QIcon::On);
  return result;
}

QIcon icon(const QString& name, const QColor& color) {
  QIcon result;
  add_sizes(result, read_drawing(name), color, QIcon::Normal, QIcon::Off);
  QColor faint = color;
  faint.setAlphaF(0.4);
  add_sizes(result, read_drawing(name), faint, QIcon::Disabled, QIcon::Off);
  return result;
}

}  // namespace handway::gui
