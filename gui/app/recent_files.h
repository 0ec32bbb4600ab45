#pragma once

#include <QMenu>
#include <QString>

namespace handway::gui {

/// File > Open recent: the last files that were opened, kept between runs.
class RecentFiles : public QMenu {
  Q_OBJECT

 public:
  explicit RecentFiles(QWidget* parent = nullptr);

  void add(const QString& file);

 signals:
  void chosen(const QString& file);

 private:
  void rebuild();
};

}  // namespace handway::gui
