#pragma once

#include "model/document/document.h"
#include "model/planning/plan_settings.h"

#include <QMenu>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QUndoStack>

class QWidget;

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

/// Opening and saving, with the questions that go with them.
class FileCommands : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param window in front of which questions are asked.
  FileCommands(QWidget& window, Document& document, PlanSettings& planning, QUndoStack& edits);

  /// What people call the scene that is open.
  [[nodiscard]] QString scene_name() const;

  /// Asks for a file. @returns empty if there is to be none.
  [[nodiscard]] QString choose();
  /// @returns whether it was saved.
  bool save();
  bool save_as();
  bool save_to(const QString& file);
  /// Asks for a file and puts a picture of `view` there.
  void save_picture(QWidget& view);
  /// Asks whether to save unsaved changes, if there are any. @returns false to stay.
  [[nodiscard]] bool may_discard();

 signals:
  void saved(const QString& file);
  void failed(const QString& title, const QString& message);

 private:
  QWidget& window_;
  Document& document_;
  PlanSettings& planning_;
  QUndoStack& edits_;
};

}  // namespace handway::gui
