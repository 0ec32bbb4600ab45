#pragma once

#include "handway/planning/timing/time_path.h"
#include "model/devices/executed_motion.h"
#include "model/devices/motion_driver.h"

#include <QWidget>

class QCheckBox;
class QFrame;
class QLabel;
class QProgressBar;
class QPushButton;

namespace handway::gui {

class FollowingPlot;
class MotionDeviceField;
class SliderRow;

/// Panel to connect to an arm and a hand, preview a motion on them, run it, and show its result.
/// The session carries out the commands of the buttons.
class DevicesPanel : public QWidget {
  Q_OBJECT

 public:
  explicit DevicesPanel(QWidget* parent = nullptr);

  [[nodiscard]] MotionDevices devices() const;
  /// "none", "emulator" or an address each.
  void choose_devices(const QString& arm, const QString& hand);
  [[nodiscard]] double speed() const;  ///< Share of full pace, in (0, 1].
  [[nodiscard]] bool mirrors() const;
  [[nodiscard]] bool is_armed() const;

  /// @param robot false if there is none to connect to.
  void show_state(MotionDriver::State state, bool robot);
  void show_problem(const QString& message);  ///< Empty: none.
  /// Shows the reason why no motion can run, or hides the reason.
  void show_no_motion(const QString& why);
  /// The robot doesn't stand where the path begins; offers to plan from where it does.
  void show_elsewhere(const QString& where);
  /// @param backwards it goes from the path's end to its start.
  void show_motion(const planning::TimedPath& motion, bool backwards);
  void show_task(const QString& name, const planning::TimedPath& motion);
  void show_part(const QString& name);  ///< The part of the task that runs; empty: none.
  void show_progress(double time, double duration, double error);
  void show_held(bool held);
  void show_outcome(const execution::MotionOutcome& outcome,
                    std::shared_ptr<const ExecutedMotion> executed,
                    const geometric::RobotModel& model);
  void clear_outcome();

 signals:
  void connect_requested();
  void disconnect_requested();
  void speed_changed();
  void run_requested();
  void hold_requested(bool held);
  void mirror_changed();
  void start_here_requested();  ///< Let the path start where the robot stands.
  /// Plan again with that margin, m.
  void margin_requested(double margin);

 private:
  QWidget* make_connection();
  QWidget* make_motion();
  QWidget* make_outcome();
  void show_state_text();
  void update_buttons();
  void offer_margin(const planning::PreflightReport& report);

  MotionDeviceField* arm_;
  MotionDeviceField* hand_;
  QPushButton* connect_;
  QLabel* state_text_;
  QFrame* problem_;
  QLabel* problem_text_;
  QCheckBox* mirror_;
  SliderRow* speed_;
  QLabel* motion_;
  QPushButton* start_here_;
  QPushButton* with_margin_;
  double margin_ = 0.0;  ///< m, margin that `with_margin_` plans with.
  QCheckBox* armed_;
  QPushButton* run_;
  QPushButton* hold_;
  QProgressBar* progress_;
  QLabel* progress_text_;
  QWidget* outcome_;
  QLabel* outcome_text_;
  FollowingPlot* plot_;
  MotionDriver::State state_ = MotionDriver::State::kOff;
  bool robot_ = false;
  bool cleared_ = false;  ///< The motion may run.
  bool held_ = false;
  QString part_;  ///< Name of the part that runs; empty: none.
};

}  // namespace handway::gui
