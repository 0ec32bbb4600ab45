#include "widgets/style/rich_text.h"

#include <QColor>

namespace handway::gui {
QString html(const QColor& color) { return color.name(QColor::HexRgb); }

QString colored(const QString& text, const QColor& color) {
  return QStringLiteral("<span style=\"color:%1\">%2</span>")
      .arg(html(color), text.toHtmlEscaped());
}

QString dotted(const QString& text, const QColor& color) {
  return QStringLiteral("<span style=\"color:%1\">●</span>&nbsp; %2")
      .arg(html(color), text.toHtmlEscaped());
}

}  // namespace handway::gui
