#include "widgets/style/icons.h"

#include "widgets/style/theme.h"

#include <QByteArray>
#include <QColor>
#include <QFile>
#include <QPainter>
#include <QPixmap>
#include <QPixmapCache>
#include <QSvgRenderer>

namespace handway::gui {
namespace {

QByteArray read_drawing(const QString& name) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

// Drawings are black; black becomes `color`.
QPixmap render(const QString& name, const QColor& color, int size) {
  QByteArray colored = read_drawing(name);
  colored.replace("#000000", color.name(QColor::HexRgb).toLatin1());
  QSvgRenderer renderer(colored);
  QPixmap pixmap(size, size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setOpacity(color.alphaF());
  renderer.render(&painter);
  return pixmap;
}

void add_sizes(QIcon& icon, const QString& name, const QColor& color, QIcon::Mode mode,
               QIcon::State state) {
  for (const int size : {16, 20, 24, 32, 40, 48}) {
    const QString key = QStringLiteral("handway/%1/%2/%3")
                            .arg(name, color.name(QColor::HexArgb), QString::number(size));
    QPixmap pixmap;
    if (!QPixmapCache::find(key, &pixmap)) {
      pixmap = render(name, color, size);
      QPixmapCache::insert(key, pixmap);
    }
    icon.addPixmap(pixmap, mode, state);
  }
}

}  // namespace

QIcon icon(const QString& name) {
  const ThemeColors colors = colors_of(current_theme());
  QColor rest = colors.text;
  rest.setAlphaF(0.82);
  QColor faint = colors.muted;
  faint.setAlphaF(0.45);
  QIcon result;
  add_sizes(result, name, rest, QIcon::Normal, QIcon::Off);
  add_sizes(result, name, colors.accent, QIcon::Normal, QIcon::On);
  add_sizes(result, name, faint, QIcon::Disabled, QIcon::Off);
  add_sizes(result, name, faint, QIcon::Disabled, QIcon::On);
  add_sizes(result, name, colors.on_accent, QIcon::Selected, QIcon::Off);
  return result;
}

QIcon icon(const QString& name, const QColor& color) {
  QIcon result;
  add_sizes(result, name, color, QIcon::Normal, QIcon::Off);
  QColor faint = color;
  faint.setAlphaF(0.4);
  add_sizes(result, name, faint, QIcon::Disabled, QIcon::Off);
  add_sizes(result, name, colors_of(current_theme()).on_accent, QIcon::Selected, QIcon::Off);
  return result;
}

}  // namespace handway::gui
