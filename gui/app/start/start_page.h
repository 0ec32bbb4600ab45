#pragma once

#include <QScrollArea>

#include <string>

class QVBoxLayout;

namespace handway::gui {

/// What an empty window shows: scenes to open, robots to begin with, recent files.
class StartPage : public QScrollArea {
  Q_OBJECT

 public:
  explicit StartPage(QWidget* parent = nullptr);

  /// Builds the page anew, after a change of theme or of the recent files.
  void refresh();

 signals:
  void open_requested(const QString& file);
  void browse_requested();
  void new_requested(const std::string& robot);

 private:
  void add_scenes(QVBoxLayout& layout);
  void add_robots(QVBoxLayout& layout);
  void add_recent(QVBoxLayout& layout);
};

}  // namespace handway::gui
