#include "widgets/panels/log_panel.h"

#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QScrollBar>
#include <QTextBlock>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr int kMostEntries = 2000;

}  // namespace

LogPanel::LogPanel(QWidget* parent) : QPlainTextEdit(parent) {
  setReadOnly(true);
  setMaximumBlockCount(kMostEntries);
  setFrameShape(QFrame::NoFrame);
  setPlaceholderText(tr("Messages appear here"));
  document()->setDocumentMargin(10);
  QFont smaller = font();
  smaller.setPixelSize(scaled(12));
  setFont(smaller);
}

void LogPanel::add(Level level, const QString& message) {
  // A long message is read from its beginning.
  QScrollBar& bar = *verticalScrollBar();
  const auto beginning = [&] {
    return std::min(bar.maximum(), document()->lastBlock().firstLineNumber());
  };
  const bool follows = bar.value() >= beginning();
  if (entries_.size() == kMostEntries) {
    entries_.pop_front();
  }
  entries_.push_back({level, QTime::currentTime(), message});
  append(entries_.back());
  if (follows) {
    bar.setValue(beginning());
  }
}

void LogPanel::append(const Entry& entry) {
  const ThemeColors colors = colors_of(current_theme());
  const QColor color = entry.level == Level::kNote      ? colors.text
                       : entry.level == Level::kWarning ? attention_color()
                                                        : colors.bad;
  appendHtml(QStringLiteral("<span style=\"color:%1\">%2</span>&nbsp; "
                            "<span style=\"color:%3\">%4</span>")
                 .arg(html(colors.muted), entry.time.toString(QStringLiteral("HH:mm:ss")),
                      html(color), entry.message.toHtmlEscaped()));
}

// The theme is another one.
void LogPanel::changeEvent(QEvent* event) {
  QPlainTextEdit::changeEvent(event);
  if (event->type() == QEvent::StyleChange && !entries_.empty()) {
    clear();
    for (const Entry& entry : entries_) {
      append(entry);
    }
  }
}

}  // namespace handway::gui
