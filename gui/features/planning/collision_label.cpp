#include "features/planning/collision_label.h"

#include "widgets/style/theme.h"

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
  QStringList all;
  for (const geometric::NamedPair& pair : report.collisions) {
    all << tr("in collision: %1").arg(pair_text(pair));
  }
  for (const std::string& violated : report.violated) {
    all << tr("violates %1").arg(QString::fromStdString(violated).toHtmlEscaped());
  }
  if (!all.empty()) {
    const int others = all.size() - 1;
    setText(dotted(colors.bad,
                   others > 0 ? tr("%1 (and %2 more)").arg(all.front()).arg(others) : all.front()));
    setToolTip(all.join(QStringLiteral("<br>")));
    return;
  }
  setToolTip({});
  setText(
      dotted(colors.good,
             report.closest
                 ? tr("free, closest: %1 to %2, %3 mm")
                       .arg(QString::fromStdString(report.closest->a).toHtmlEscaped(),
                            QString::fromStdString(report.closest->b).toHtmlEscaped())
                       .arg(report.closest->distance * 1e3, 0, 'f', 1)
                 : tr("free, nothing within %1 mm").arg(CollisionMonitor::kNear * 1e3, 0, 'f', 0)));
}

void CollisionLabel::show_nothing() {
  clear();
  setToolTip({});
}

}  // namespace handway::gui
