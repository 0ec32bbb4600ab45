#pragma once

#include "model/document/joint_groups.h"

#include <QDialog>
#include <QObject>
#include <QStringList>

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

class Document;
class PostureBar;
class SceneEditor;

/// Asks under which name a posture is kept, and of which part of the robot.
class KeepPostureDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param taken names of postures that are kept already: one of them is kept in its place.
  KeepPostureDialog(const JointGroups& groups, const QStringList& taken, QWidget* parent = nullptr);

  [[nodiscard]] QString name() const;
  /// The variables that belong to it.
  [[nodiscard]] const std::vector<int>& variables() const;

 private:
  void add_part(const QString& text, std::vector<int> variables);
  void look_at_name();

  QStringList taken_;
  std::vector<std::vector<int>> parts_;  ///< By row of the choice.
  QLineEdit* name_;
  QComboBox* part_;
  QLabel* note_;
  QPushButton* keep_;
};

/// Keeps postures by name in the scene, and forgets them again, each in an edit that can be undone.
class KeptPostures : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param keep asks for it, in menus.
  KeptPostures(const Document& document, SceneEditor& editor, PostureBar& bar, QAction& keep,
               QObject* parent = nullptr);

 private:
  /// Asks for a name.
  void keep_this();

  const Document& document_;
  SceneEditor& editor_;
  PostureBar& bar_;
};

}  // namespace handway::gui
