#pragma once

#include <QPlainTextEdit>
#include <QTime>

#include <deque>

namespace handway::gui {

/// Log of events, one per line, with the time of day.
class LogPanel : public QPlainTextEdit {
  Q_OBJECT

 public:
  enum class Level { kNote, kWarning, kError };

  explicit LogPanel(QWidget* parent = nullptr);

  void add(Level level, const QString& message);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Entry {
    Level level;
    QTime time;
    QString message;
  };

  /// Appends an entry in the current theme's colours.
  void append(const Entry& entry);

  std::deque<Entry> entries_;
};

}  // namespace handway::gui
