#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/revision.h"
#include "handway/planning/extensions/importer.h"
#include "handway/planning/extensions/plugin.h"
#include "model/document/joint_groups.h"
#include "model/document/prepared_problem.h"
#include "model/document/recorded_hand.h"
#include "model/document/scene_edits.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace handway::gui {

/// A scene with nothing but a robot of the library, and the first hand basis of the
/// library that fits it. @throws InputError if there is no such robot.
[[nodiscard]] planning::LoadedScene new_scene(const std::string& robot,
                                              const planning::Extensions& extensions);

/// Writes a scene as Handway's own format, the first robot standing at `shown`.
/// The hand's basis of an imported problem goes into `STEM_hand.yaml` beside it.
/// @param shown shape [variable_count] of the first robot; unused without robots.
/// @throws InputError if a file can't be written.
void save_scene(const planning::LoadedScene& loaded, const geometric::Configuration& shown,
                const geometric::PlannerRequest& planner, const std::filesystem::path& file);

/// Reads scene files off the GUI thread.
class SceneLoader : public QObject {
  Q_OBJECT

 public:
  explicit SceneLoader(std::shared_ptr<const planning::Extensions> extensions,
                       QObject* parent = nullptr);
  ~SceneLoader() override;

  /// Reads `file`, without waiting; what an earlier call is still reading is dropped.
  void load(const std::filesystem::path& file);

  /// Makes a new scene with a robot of the library in the same way.
  void create(const std::string& robot);

 signals:
  void loaded(const handway::planning::LoadedScene& scene);
  /// @param message one sentence for a person.
  void failed(const QString& message);

 private:
  void run(std::function<planning::LoadedScene()> read);

  std::shared_ptr<const planning::Extensions> extensions_;
  int generation_ = 0;
  BackgroundThreads threads_;
};

/// The scene that is open, and the posture in which its first robot is shown.
class Document : public QObject {
  Q_OBJECT

 public:
  explicit Document(std::shared_ptr<const planning::Extensions> extensions,
                    QObject* parent = nullptr);

  [[nodiscard]] const std::shared_ptr<const geometric::Scene>& scene() const {
    return state_.scene;
  }
  /// The scene, and which objects are hidden or locked.
  [[nodiscard]] const SceneState& state() const { return state_; }
  [[nodiscard]] const planning::LoadedScene& loaded() const { return loaded_; }
  /// What results of this moment are made from. Any edit makes it another one, undoing included.
  [[nodiscard]] const planning::Revision& revision() const { return revision_; }
  /// For planning and collision checks; null if there is no robot.
  [[nodiscard]] const std::shared_ptr<const PreparedProblem>& problem() const { return problem_; }
  /// The first robot; nullptr if there is none.
  [[nodiscard]] const geometric::RobotInstance* robot() const;
  [[nodiscard]] const JointGroups& groups() const { return groups_; }
  [[nodiscard]] int palm() const { return palm_; }
  [[nodiscard]] const geometric::Configuration& configuration() const { return q_; }
  /// What the hand is compared with.
  [[nodiscard]] RecordedHand& recorded_hand() { return recorded_hand_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// Begins to read `file`; opened() or open_failed() follows.
  void open(const std::filesystem::path& file);
  /// Reads `copy`, but goes by the name of `file` (or none).
  void open_copy(const std::filesystem::path& copy, const std::filesystem::path& file);
  /// Begins a new scene with a robot of the library; opened() or open_failed() follows.
  void create(const std::string& robot);
  /// Writes the scene with the robot as it stands, and goes by that name from now on.
  /// @throws InputError if a file can't be written.
  void save(const std::filesystem::path& file, const geometric::PlannerRequest& planner);
  /// Shows another scene, that is in memory already.
  void set_scene(planning::LoadedScene scene, const std::filesystem::path& file = {});
  /// Replaces the scene by an edited one with the same robots.
  void set_state(SceneState state);
  /// Moves the first robot, unless it is shown as measured. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// Sets the joints that the posture names, unless the robot is shown as measured.
  void apply_posture(const geometric::NamedPosture& posture);
  /// Shows the first robot as it is measured, and nothing else, until hide_measured().
  /// @param q shape [variable_count].
  void show_measured(const geometric::Configuration& q);
  void hide_measured();
  [[nodiscard]] bool shows_measured() const { return shows_measured_; }

 signals:
  void opening(const QString& file);
  void opened();
  /// An edit, of which `before` was the state.
  void edited(const handway::gui::SceneState& before);
  /// The scene from before stays.
  void open_failed(const QString& message);
  void configuration_changed(const Eigen::VectorXd& q);
  /// The robot is shown as measured from now on, or no longer.
  void measured_shown(bool shown);

 private:
  SceneLoader loader_;
  PreparationQueue preparations_;
  SceneState state_;
  planning::LoadedScene loaded_;  ///< With the scene of `state_`.
  planning::Revision revision_;
  std::shared_ptr<const PreparedProblem> problem_;
  RecordedHand recorded_hand_;
  JointGroups groups_;
  int palm_ = 0;
  geometric::Configuration q_;
  bool shows_measured_ = false;
  std::filesystem::path file_;
  std::filesystem::path requested_;
};

}  // namespace handway::gui
