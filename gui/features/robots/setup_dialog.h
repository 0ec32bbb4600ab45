#pragma once

#include "features/robots/group_table.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/scene/scene.h"
#include "handway/geometric/setup/collision_sampling.h"
#include "handway/geometric/setup/robot_setup.h"
#include "model/document/scene_editor.h"
#include "model/jobs/background.h"

#include <QDialog>
#include <QString>

#include <filesystem>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class QTabWidget;

namespace handway::gui {

class PairTable;
class SceneView;

/// One of the robots of a scene, or of those mounted on each other, by the file it came from.
struct RobotFile {
  std::string name;
  std::shared_ptr<const geometric::RobotModel> model;
  std::filesystem::path srdf;  ///< Beside the robot's file; empty: that is no URDF.
};

[[nodiscard]] std::vector<RobotFile> robot_files(const geometric::Scene& scene);

/// Dialog for `handway setup` with a view of the robot: samples self-collisions, proposes groups,
/// lists suspicious findings with their remedy and shows them in the view, writes the SRDF and
/// applies it to the scene.
class SetupDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param editor outlives it; its scene has a robot. @param robot of robot_files(); by name.
  SetupDialog(SceneEditor& editor, const std::string& robot, QWidget* parent = nullptr);

  /// Returns whether pairs are still being sampled.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] const std::vector<geometric::RobotFinding>& findings() const { return findings_; }

 signals:
  void written(const QString& file);

 private:
  QWidget* make_view();
  QWidget* make_panel();
  QWidget* make_choices();
  QWidget* make_sampling();
  QWidget* make_joints();
  QWidget* make_pairs();
  QWidget* make_buttons();
  void show_robot();
  void sample();
  void take_samples(geometric::SelfCollisionSamples sampled);
  void examine();
  void decide_wrist();
  void move_joints(const JointOwners& owners);
  void show_groups();
  void show_findings();
  void show_finding(int row);
  void show_pairs();
  void show_posture();
  void show_outcome(const QString& words, bool is_problem);
  void write();
  [[nodiscard]] const RobotFile& chosen() const;
  [[nodiscard]] geometric::WristOwner wrist() const;
  /// Returns the groups that the robot has or that were found, with the user's changes.
  [[nodiscard]] geometric::GroupProposal groups_by_now() const;
  /// Returns whether the user has changed the groups.
  [[nodiscard]] bool groups_are_decided() const;
  /// Robot with what was sampled and decided.
  [[nodiscard]] geometric::RobotDescription set_up() const;

  SceneEditor& editor_;
  std::vector<RobotFile> robots_;
  geometric::SelfCollisionSamples sampled_;
  geometric::GroupProposal groups_;
  std::vector<geometric::RobotFinding> findings_;
  std::map<geometric::AllowedCollisions::Pair, bool> allowed_collisions_;  ///< By hand.
  JointOwners moved_;                                                      ///< By hand.
  SceneView* view_;
  QComboBox* robot_;
  QComboBox* posture_;
  QComboBox* wrist_;
  QLabel* wrist_label_;
  QLabel* group_text_;
  QListWidget* list_;
  QTabWidget* tabs_;
  QComboBox* kind_;
  GroupTable* joints_;
  QPushButton* as_found_;
  PairTable* pairs_;
  QLabel* sampling_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QPushButton* again_;
  QLabel* outcome_;
  QPushButton* write_;
  std::stop_source stop_;  ///< Stops the sampling, whose samples are used.
  LatestJob job_;
};

}  // namespace handway::gui
