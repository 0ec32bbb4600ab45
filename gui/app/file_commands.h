#pragma once

#include <QMenu>
#include <QObject>
#include <QString>
#include <QStringList>

class QAction;
class QWidget;

namespace handway::gui {

class Workbench;

/// File > Open recent: the last files that were opened, kept between runs.
class RecentFiles : public QMenu {
  Q_OBJECT

 public:
  explicit RecentFiles(QWidget* parent = nullptr);

  /// Returns the recent files that still exist, the most recent first.
  [[nodiscard]] static QStringList files();
  void add(const QString& file);

 signals:
  void chosen(const QString& file);

 private:
  void rebuild();
};

/// The commands of the File menu that open and save, with the questions that go with them.
class FileCommands : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit FileCommands(Workbench& workbench);

  /// The scene that is shown is another one, or none.
  void show_scene();
  /// Asks for the robots of a new scene; those of the open scene are preselected.
  void choose_new();
  /// Asks for a scene and opens it.
  void open();
  /// @returns whether it was saved.
  bool save();
  bool save_as();
  /// Asks whether to save unsaved changes, if there are any. @returns false to stay.
  [[nodiscard]] bool may_discard();

 signals:
  void saved();

 private:
  void place_actions();
  /// Asks whether to replace a file that was changed by others.
  [[nodiscard]] bool may_overwrite(const QString& file);
  bool save_to(const QString& file);
  /// Asks for a file and puts a picture of the view there.
  void save_picture();

  Workbench& workbench_;
  RecentFiles* recent_;
  QAction* open_;
  QAction* save_;
  QAction* save_as_;
  QAction* picture_;
  QAction* close_;
};

}  // namespace handway::gui
