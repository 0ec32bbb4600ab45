#pragma once

#include "features/planning/plan_panel.h"
#include "model/document/document.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

class QWidget;

namespace handway::gui {

/// Opening and saving, with the questions that go with them.
class FileCommands : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param window in front of which questions are asked.
  FileCommands(QWidget& window, Document& document, PlanPanel& plan_panel, QUndoStack& edits);

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
  PlanPanel& plan_panel_;
  QUndoStack& edits_;
};

}  // namespace handway::gui
