#pragma once

#include "features/devices/stop_controls.h"
#include "model/devices/executed_motion.h"
#include "model/devices/motion_driver.h"
#include "model/devices/stop_key_listener.h"
#include "model/planning/timing_runner.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

class QPushButton;
class QWidget;

namespace handway::planning {
struct SceneState;
}

namespace handway::gui {

class DevicesPanel;
class Document;
class PathPlayer;

/// Runs the path on screen on the hardware: times it, clears it from the measured posture, runs it,
/// shows the measured robot, and keeps the executed motion. An edit of the scene revokes the
/// clearance, and reaches a running motion.
class DeviceSession : public QObject {
  Q_OBJECT

 public:
  /// All outlive the session. Makes the panel and the stop button; a window takes them over.
  DeviceSession(Document& document, PathPlayer& player, MotionDriver& driver,
                QObject* parent = nullptr);

  [[nodiscard]] DevicesPanel* panel() const { return panel_; }
  /// Stops the robot; to be where it is always seen. Hidden while nothing is connected.
  [[nodiscard]] QPushButton* stop_button() const { return stop_; }

  /// Call this before the scene or the program is left. If the robot moves, it asks whether to stop
  /// it, stops it, and waits until it is at rest. @returns false to stay.
  [[nodiscard]] bool may_leave(QWidget& window);

  /// Runs a planned task next, instead of the path on screen.
  void take_task(const DerivedSource& task);
  /// Runs the path on screen next. What runs already is not changed.
  void forget_task();

  /// Sets the clearance that has to remain beyond the robot's following error, m.
  void set_margin(double margin);

  /// Returns the folder of the logs of motions.
  [[nodiscard]] static std::filesystem::path log_folder();

 signals:
  /// The palm's curve as it was measured (world, m); empty: none.
  void executed_changed(const std::vector<Eigen::Vector3d>& curve);
  /// Let the start be where the robot stands, and plan.
  void start_here_requested(const Eigen::VectorXd& q);
  /// Plan again with that margin, m.
  void margin_requested(double margin);
  /// Emitted while a task runs, with an object that it moves, and the object's pose in the world.
  void carried(const QString& object, const handway::geometric::Pose& X_WO);
  /// Emitted when objects are again where the scene has them.
  void carried_ended();
  /// A task has run to its end. @param after the scene as the task leaves it.
  void task_done(const handway::planning::SceneState& after);
  /// Emitted with a message for the log.
  void reported(bool good, const QString& message);

 private:
  void connect_devices();
  void time_again();
  void time_path(const planning::TimingOptions& options);
  void time_task(const planning::TimingOptions& options);
  void run();
  void on_state_changed(MotionDriver::State state);
  void show_stop(bool active);
  void take_measured(const Eigen::VectorXd& q);
  void take_edit(const planning::SceneState& before);
  /// Shows the objects of the task that runs where they are at the measured configuration.
  void show_carried();
  /// The document's robot as it is measured, if that is wanted.
  void mirror();
  void take_outcome(const execution::MotionOutcome& outcome,
                    const std::shared_ptr<const ExecutedMotion>& executed);

  Document& document_;
  PathPlayer& player_;
  DevicesPanel* panel_;
  StopControls stop_controls_;
  QPushButton* stop_;
  TimingRunner timing_;
  MotionDriver& driver_;
  std::optional<StopKeyListener> stop_keys_;   ///< While there is something to stop.
  DerivedMotion motion_;                       ///< Motion of the path on screen, or null.
  bool backwards_ = false;                     ///< motion_ goes from goal to start.
  geometric::Configuration measured_;          ///< Has size 0 while nothing is connected.
  geometric::Configuration timed_from_;        ///< `measured_` when motion_ was timed.
  planning::Path timed_path_;                  ///< Path that is timed, from start to goal.
  std::optional<DerivedSource> task_;          ///< The task to run; empty: the path on screen.
  std::optional<DerivedSource> running_task_;  ///< The task that runs; empty: a path, or nothing.
  std::size_t stage_ = 0;                      ///< Stage of the task that runs.
  planning::SafetyMargin safety_;              ///< With what these devices were seen to miss.
};

}  // namespace handway::gui
