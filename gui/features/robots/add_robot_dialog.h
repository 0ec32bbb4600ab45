#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/extensions/plugin.h"
#include "model/document/scene_editor.h"
#include "model/jobs/background.h"

#include <QDialog>
#include <QString>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

class PoseForm;

/// Folders in which meshes of robots were found, kept between runs: has them looked through for
/// packages and meshes. To be called once.
void use_package_path();
/// Adds one.
void remember_package_path(const QString& folder);

/// Asks for a robot's file. @returns empty if the user cancels.
[[nodiscard]] QString choose_robot_file(QWidget* parent);

/// Asks for a robot of the library or of a file, and for its place: in the world, or on a link of a
/// robot that is there. While the dialog is open, selecting a link in the tree or the view chooses
/// it as the mount.
class AddRobotDialog : public QDialog {
  Q_OBJECT

 public:
  /// Function that returns a free pose for a robot placed in the world. @param robot as it was
  /// read.
  using FreePlace = std::function<geometric::Pose(const geometric::RobotInstance& robot)>;

  /// The editor outlives the dialog.
  AddRobotDialog(std::shared_ptr<const planning::PluginManager> plugins, SceneEditor& editor,
                 FreePlace free_place, QWidget* parent = nullptr);

  /// Reads a robot file and chooses it. Asks for the arguments of a xacro file.
  void choose_file(const std::filesystem::path& file);

 signals:
  /// @param warnings of its file, one a line.
  void added(const QString& name, const QString& warnings);

 private:
  QWidget* make_form();
  void list_library();
  void list_links();
  void browse();
  /// Asks for a folder and searches it for the missing meshes of the robot's file.
  void search();
  void read_chosen();
  void take_robot(geometric::RobotInstance robot);
  void show_note(const QString& note, bool is_problem);
  void show_place();
  void follow_selection(const SceneItem& item);
  [[nodiscard]] std::optional<planning::LinkOfRobot> chosen_link() const;
  void choose_link(const planning::LinkOfRobot& link);
  void add();

  std::shared_ptr<const planning::PluginManager> plugins_;
  SceneEditor& editor_;
  FreePlace free_place_;
  QComboBox* model_;
  QLabel* note_;
  QPushButton* search_;
  QLineEdit* name_;
  QComboBox* on_;
  PoseForm* pose_;
  QPushButton* add_;
  std::map<int, geometric::XacroArguments> arguments_;  ///< By rows of `model_`.
  geometric::Pose X_;                                   ///< In the world or the chosen link.
  std::optional<geometric::RobotInstance> robot_;       ///< The robot as read; nothing: not yet.
  LatestJob job_;
};

}  // namespace handway::gui
