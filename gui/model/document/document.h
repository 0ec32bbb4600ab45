#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// The arm, and each finger by itself: variables of the hand of which one moves the other's link.
[[nodiscard]] std::vector<geometric::JointIndices> moving_parts(
    const geometric::RobotModel& model, const geometric::JointSelection& joints);

/// The recorded postures that a hand is compared with: those that its basis names, or those of a
/// file that a person chose, read in the background.
class RecordedHand : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kNone,  ///< The basis names none, and none were chosen; or there is no basis.
    kReading,
    kReady,
    kFailed,
  };

  explicit RecordedHand(QObject* parent = nullptr);

  /// Sets the basis of another scene. Choices are kept for the same hand. @param basis may be null.
  void set_basis(std::shared_ptr<const sampling::PmdBasis> basis);
  /// Compares with a file's postures (sampling::read_postures()) instead of the basis'.
  void choose(const std::filesystem::path& file);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const std::shared_ptr<const sampling::PmdBasis>& basis() const { return basis_; }
  /// Returns the postures; null unless kReady.
  [[nodiscard]] const std::shared_ptr<const sampling::RecordedPostures>& postures() const {
    return postures_;
  }
  /// Returns the reason why they couldn't be read; a sentence.
  [[nodiscard]] const QString& fault() const { return fault_; }

 signals:
  void changed();

 private:
  void read();

  std::shared_ptr<const sampling::PmdBasis> basis_;
  std::filesystem::path chosen_;
  std::string chosen_for_;  ///< Hand.
  State state_ = State::kNone;
  std::shared_ptr<const sampling::RecordedPostures> postures_;
  QString fault_;
  LatestJob job_;
};

/// Writes a scene as Handway's own format, the first robot standing at `shown`. A task without a
/// start keeps the one that it has: where the robot stood.
/// The hand's basis of an imported problem goes into `STEM_hand.yaml` beside it.
/// @param shown shape [variable_count] of the first robot; unused without robots.
/// @throws InputError if a file can't be written.
void save_scene(const planning::SceneState& loaded, const geometric::Configuration& shown,
                const geometric::PlannerRequest& planner, const std::filesystem::path& file);

/// Reads scene files off the GUI thread.
class SceneLoader : public QObject {
  Q_OBJECT

 public:
  explicit SceneLoader(std::shared_ptr<const planning::PluginManager> plugins,
                       QObject* parent = nullptr);
  ~SceneLoader() override;

  /// Reads `file`, without waiting; what an earlier call is still reading is dropped.
  /// @param arguments of a robot file in xacro.
  void load(const std::filesystem::path& file, const geometric::XacroArguments& arguments = {});

  /// Makes a new scene with a robot of the library, and a hand on it, in the same way.
  void create(const std::string& robot, const std::string& hand);
  /// Drops what is still being read.
  void cancel() { ++generation_; }

 signals:
  void loaded(const handway::planning::SceneState& scene);
  /// @param message one sentence for a person.
  void failed(const QString& message);

 private:
  void run(std::function<planning::SceneState()> read);

  std::shared_ptr<const planning::PluginManager> plugins_;
  int generation_ = 0;
  BackgroundJobs jobs_;
};

/// Identifies the state of a file, to detect changes.
struct FileStamp {
  std::filesystem::file_time_type time = {};
  std::uintmax_t size = 0;

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// The scene that is open, and the posture in which its first robot is shown.
class Document : public QObject {
  Q_OBJECT

 public:
  /// Reasons why other robots are shown than before.
  enum class Opened {
    kScene,   ///< Another scene is open, or none.
    kRobots,  ///< An edit of the open one added, mounted or removed robots, or was undone.
  };
  Q_ENUM(Opened)

  explicit Document(std::shared_ptr<const planning::PluginManager> plugins,
                    QObject* parent = nullptr);

  [[nodiscard]] const std::shared_ptr<const geometric::Scene>& scene() const {
    return state_.scene;
  }
  /// The scene, and which objects are hidden or locked.
  [[nodiscard]] const planning::SceneState& state() const { return state_; }
  [[nodiscard]] const planning::SceneState& loaded() const { return loaded_; }
  /// Returns the revision that present results depend on. Any edit changes it, undo included.
  [[nodiscard]] const planning::Revision& revision() const { return revision_; }
  /// Returns the problem for planning and collision checks; null if there is no robot.
  [[nodiscard]] const std::shared_ptr<const PreparedProblem>& problem() const { return problem_; }
  /// The first robot; nullptr if there is none.
  [[nodiscard]] const geometric::RobotInstance* robot() const;
  [[nodiscard]] const geometric::JointSelection& joints() const { return joints_; }
  [[nodiscard]] int palm() const { return palm_; }
  [[nodiscard]] const geometric::Configuration& configuration() const { return q_; }
  /// Returns the recorded postures that the hand is compared with.
  [[nodiscard]] RecordedHand& recorded_hand() { return recorded_hand_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// Returns whether the scene's file has changed since it was read or written here, by another
  /// window or program.
  [[nodiscard]] bool is_changed_on_disk() const;

  /// Begins to read `file`; opened() or open_failed() follows.
  /// @param arguments of a robot file in xacro.
  void open(const std::filesystem::path& file, const geometric::XacroArguments& arguments = {});
  /// Reads `copy`, but goes by the name of `file` (or none).
  void open_copy(const std::filesystem::path& copy, const std::filesystem::path& file);
  /// Begins a new scene as new_scene() makes it; opened() or open_failed() follows.
  void create(const std::string& robot, const std::string& hand);
  /// Writes the scene with the robot as it stands, and goes by that name from now on.
  /// @throws InputError if a file can't be written.
  void save(const std::filesystem::path& file, const geometric::PlannerRequest& planner);
  /// Shows another scene, that is in memory already.
  void set_scene(planning::SceneState scene, const std::filesystem::path& file = {});
  /// Shows none.
  void close();
  /// Replaces the scene by an edited one, and the hand's basis; opened() follows where its robots
  /// are others, edited() in any case. Joints that the first robot has in both stay where they are
  /// shown.
  void set_state(planning::SceneState state);
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
  void opened(handway::gui::Document::Opened what);
  /// An edit, of which `before` was the state.
  void edited(const handway::planning::SceneState& before);
  /// An edit of the hand's basis, and with it of which joints are arm and hand.
  void hand_changed();
  /// The scene from before stays.
  void open_failed(const QString& message);
  void configuration_changed(const Eigen::VectorXd& q);
  /// The robot is shown as measured from now on, or no longer.
  void measured_shown(bool shown);

 private:
  /// Begins to read `read`, which goes by the name of `file`.
  void request(const std::filesystem::path& read, const std::filesystem::path& file,
               const geometric::XacroArguments& arguments);
  /// Updates the data that follow from the robot and the hand's basis.
  void take_hand();
  void use_first_robot(const geometric::Configuration& q);
  void change_robots(planning::SceneState state);

  SceneLoader loader_;
  PreparationQueue preparations_;
  planning::SceneState state_;
  planning::SceneState loaded_;  ///< With scene and basis of `state_`.
  planning::Revision revision_;
  std::shared_ptr<const PreparedProblem> problem_;
  RecordedHand recorded_hand_;
  geometric::JointSelection joints_;
  int palm_ = 0;
  geometric::Configuration q_;
  bool shows_measured_ = false;
  std::filesystem::path file_;
  std::filesystem::path requested_;
  FileStamp stamp_;            ///< Stamp of `file_` when read or written.
  FileStamp requested_stamp_;  ///< Stamp of `requested_` before it is read.
};

}  // namespace handway::gui
