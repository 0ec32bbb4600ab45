#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/scene/scene.h"
#include "model/document/document.h"

#include <QDialog>
#include <QObject>
#include <QStringList>
#include <QWidget>

#include <memory>

class QMenu;
class QPushButton;
class QToolButton;

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;

namespace handway::gui {

class Document;
class ElbowSwing;
class JointPanel;
class PmdPanel;
class Workbench;
struct SceneItem;

/// Buttons that move the first robot to start, goal or a named posture, of the scene or of the
/// robot's own files.
class PostureBar : public QWidget {
  Q_OBJECT

 public:
  explicit PostureBar(QWidget* parent = nullptr);

  /// Sets the scene; null: none.
  void set_scene(const std::shared_ptr<const geometric::Scene>& scene);

 signals:
  void start_requested();
  void goal_requested();
  void posture_requested(const handway::geometric::NamedPosture& posture);
  void keep_requested();
  void forget_requested(const QString& name);

 private:
  void list_postures(const geometric::Scene& scene);

  QPushButton* start_;
  QPushButton* goal_;
  QPushButton* postures_;
  QMenu* menu_;
};

/// Named postures, joint sliders, and principal motion directions. Each shows the document's
/// posture; whichever is touched sets it.
class PosturePanels : public QObject {
  Q_OBJECT

 public:
  /// Adds the panels to the window. @param workbench outlives them.
  explicit PosturePanels(Workbench& workbench);

 private:
  void connect_panels();
  void add_commands();
  /// Shows the document's robot, which may be another than before.
  void show_robot();
  /// Brings the slider of the joint of a link to the front.
  void show_item(const SceneItem& item) const;

  Workbench& workbench_;
  Document& document_;
  PostureBar* postures_;
  ElbowSwing* swing_;
  JointPanel* joints_;
  PmdPanel* hand_;
};

/// Adds the panels of joints and hand, and the commands that set start and goal and keep postures.
void add_postures(Workbench& workbench);

class SceneEditor;

/// Asks for the name of a posture to save, and the part of the robot.
class KeepPostureDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param taken names of postures that are kept already: one of them is kept in its place.
  KeepPostureDialog(const geometric::JointSelection& joints, const QStringList& taken,
                    QWidget* parent = nullptr);

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

/// Saves postures by name in the scene, and removes them again, each in an edit that can be undone.
class KeptPostures : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param keep asks for it, in menus.
  KeptPostures(const Document& document, SceneEditor& editor, PostureBar& bar, QAction& keep,
               QObject* parent = nullptr);

 private:
  /// Asks for a name and saves the posture.
  void keep_this();

  const Document& document_;
  SceneEditor& editor_;
  PostureBar& bar_;
};

}  // namespace handway::gui
