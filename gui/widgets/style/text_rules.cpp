#include "widgets/style/tooltips.h"

#include <QApplication>
#include <QFontMetrics>
#include <QHelpEvent>
#include <QTextDocument>
#include <QToolTip>
#include <QWidget>

namespace handway::gui {

WrappedTooltips::WrappedTooltips(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool WrappedTooltips::eventFilter(QObject* watched, QEvent* event) {
  constexpr int kLettersInALine = 70;
  if (event->type() != QEvent::ToolTip || !watched->isWidgetType()) {
    return QObject::eventFilter(watched, event);
  }
  auto* widget = static_cast<QWidget*>(watched);
  const QString tip = widget->toolTip();
  const QFontMetrics metrics(QToolTip::font());
  const int line = kLettersInALine * metrics.averageCharWidth();
  if (Qt::mightBeRichText(tip) || metrics.size(0, tip).width() <= line) {
    return QObject::eventFilter(watched, event);
  }
  // Rich text has its lines broken.
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                     Qt::convertFromPlainText(tip, Qt::WhiteSpaceNormal), widget);
  return true;
}

}  // namespace handway::gui
