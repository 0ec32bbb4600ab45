#include "widgets/panels/log_panel.h"

#include "widgets/style/theme.h"

#include <QTime>

namespace handway::gui {

LogPanel::LogPanel(QWidget* parent) : QPlainTextEdit(parent) {
  setReadOnly(true);
  setMaximumBlockCount(2000);
  setFrameShape(QFrame::NoFrame);
  setPlaceholderText(tr("Messages appear here"));
  document()->setDocumentMargin(10);
  QFont smaller = font();
  smaller.setPixelSize(scaled(12));
  setFont(smaller);
}

void LogPanel::add(Level level, const QString& message) {
  const ThemeColors colors = colors_of(current_theme());
  const QColor color = level == Level::kNote      ? colors.text
                       : level == Level::kWarning ? QColor(0xb4, 0x6a, 0x00)
                                                  : colors.bad;
  appendHtml(QStringLiteral("<span style=\"color:%1\">%2</span>&nbsp; "
                            "<span style=\"color:%3\">%4</span>")
                 .arg(html(colors.muted), QTime::currentTime().toString(QStringLiteral("HH:mm:ss")),
                      html(color), message.toHtmlEscaped()));
}

}  // namespace handway::gui
