#pragma once

#include <QMenu>
#include <QString>
#include <QStringList>

namespace handway::gui {

/// File > Open recent: the last files that were opened, kept between runs.
class RecentFiles : public QMenu {
  Q_OBJECT

 public:
  explicit RecentFiles(QWidget* parent = nullptr);

  /// Those that are still there, the last first.
  [[nodiscard]] static QStringList files();
  void add(const QString& file);

 signals:
  void chosen(const QString& file);

 private:
  void rebuild();
};

}  // namespace handway::gui
