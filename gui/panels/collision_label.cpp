#include "panels/collision_label.h"

#include "style/theme.h"

#include <QStringList>

namespace handway::gui {
namespace {

QString dotted(const QColor& color, const QString& text) {
  return QStringLiteral("<span style=\"color:%1\">●</span>&nbsp; %2").arg(html(color), text);
}

QString pair_text(const geometric::NamedPair& pair) {
  return QObject::tr("%1 with %2")
      .arg(QString::fromStdString(pair.a).toHtmlEscaped(),
           QString::fromStdString(pair.b).toHtmlEscaped());
}

}  // namespace

CollisionLabel::CollisionLabel(QWidget* parent) : QLabel(parent) {
  setContentsMargins(8, 0, 8, 0);
  setTextFormat(Qt::RichText);
}

void CollisionLabel::show_report(const CollisionReport& report) {
  const ThemeColors colors = colors_of(current_theme());
  if (report.collisions.empty()) {
    setToolTip({});
    if (report.closest) {
      setText(
          dotted(colors.good, tr("free, closest: %1 to %2, %3 mm")
                                  .arg(QString::fromStdString(report.closest->a).toHtmlEscaped(),
                                       QString::fromStdString(report.closest->b).toHtmlEscaped())
                                  .arg(report.closest->distance * 1e3, 0, 'f', 1)));
    } else {
      setText(
          dotted(colors.good,
                 tr("free, nothing within %1 mm").arg(CollisionMonitor::kNear * 1e3, 0, 'f', 0)));
    }
    return;
  }
  QString text = tr("in collision: %1").arg(pair_text(report.collisions.front()));
  if (report.collisions.size() > 1) {
    text += tr(" (and %1 more)").arg(report.collisions.size() - 1);
  }
  setText(dotted(colors.bad, text));
  QStringList all;
  for (const geometric::NamedPair& pair : report.collisions) {
    all << pair_text(pair);
  }
  setToolTip(all.join(QStringLiteral("<br>")));
}

void CollisionLabel::show_nothing() {
  clear();
  setToolTip({});
}

}  // namespace handway::gui
