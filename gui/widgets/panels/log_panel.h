#pragma once

#include <QPlainTextEdit>

namespace handway::gui {

/// What happened, line by line, with the time of day.
class LogPanel : public QPlainTextEdit {
  Q_OBJECT

 public:
  enum class Level { kNote, kWarning, kError };

  explicit LogPanel(QWidget* parent = nullptr);

  void add(Level level, const QString& message);
};

}  // namespace handway::gui
