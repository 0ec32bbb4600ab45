#pragma once

#include "handway/execution/motion/motion_parts.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/timing/time_path.h"
#include "model/devices/executed_motion.h"
#include "model/document/prepared_problem.h"

#include <QObject>
#include <QString>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace handway::gui {

/// Devices that move the robot: addresses such as "arm://localhost:11000", and emulated ones that
/// start in the robot's configuration.
struct MotionDevices {
  QString addresses;  ///< For execution::parse_targets(); may be empty.
  bool emulated_arm = false;
  bool emulated_hand = false;
};

/// Keeps the connection to an arm and a hand on a thread of its own, reports their joints, and runs
/// motions on them.
class MotionDriver : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kOff,
    kConnecting,
    kConnected,
    kRunning,  ///< A motion, held or not.
    kClosing,
  };
  using Problem = std::shared_ptr<const planning::PlanningProblem>;

  explicit MotionDriver(QObject* parent = nullptr);
  ~MotionDriver() override;

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool is_held() const { return requests_ && requests_->hold; }

  /// @param q where the robot is shown: emulated devices stand there. @pre kOff
  void connect_to(const MotionDevices& devices, Problem problem, geometric::Configuration q);
  /// Stops what runs, and lets go of the devices.
  void disconnect_all();
  /// Runs a motion that is cleared(), if it is free in the scene as it is by then.
  /// @param scene as it is now. @param log file for MotionLog. @pre kConnected
  void run(std::shared_ptr<const planning::TimedPath> motion,
           std::shared_ptr<const PreparedProblem> scene, std::filesystem::path log);
  /// Runs the motion of a task. An edit of the scene holds it for good.
  /// @param stages scenes of its stages. The others as above.
  void run_task(std::shared_ptr<const planning::TimedPath> motion,
                const std::vector<planning::SceneState>& stages, std::filesystem::path log);
  /// The scene was edited: what is left of a motion that runs is checked in it.
  void follow(std::shared_ptr<const PreparedProblem> scene);
  /// A motion goes on only if the rest of it is free; otherwise held() follows.
  void hold(bool held);
  /// Stops all joints as fast as the devices can. From any thread.
  void stop();
  /// Stops what moves and waits for its end. From any thread.
  /// @returns whether the robot is at rest: nothing moved, or all devices were measured at rest.
  bool stop_and_wait(std::chrono::milliseconds longest);
  /// Stops what moves, lets go of the devices, and waits for that. For the end of the program: no
  /// signal is emitted. @returns whether the robot is at rest.
  bool end(std::chrono::milliseconds longest);

 signals:
  void state_changed(handway::gui::MotionDriver::State state);
  /// Emitted with the measured configuration, about 30 times per second. Joints without a device
  /// keep their values.
  void measured(const Eigen::VectorXd& q);
  /// A part of a motion begins. @param stage that it belongs to. @param name for display: "lift
  /// (pick can)"; empty: a path.
  void part_begun(int stage, const QString& name);
  /// @param time s of the motion. @param error farthest that a joint was off so far, rad.
  void progressed(double time, double duration, double error);
  /// The motion is held because of the scene, or could go on now. @param reason a sentence.
  void held(const QString& reason);
  void ended(const handway::execution::MotionOutcome& outcome,
             const std::shared_ptr<const handway::gui::ExecutedMotion>& executed);
  /// The connection could not be made or is lost, or a motion not begun.
  void failed(const QString& message);

 private:
  struct Order {
    std::shared_ptr<const planning::TimedPath> motion;
    std::vector<execution::MotionPart> parts;
    std::filesystem::path log;
    std::shared_ptr<execution::MotionRequests> requests;
    std::shared_ptr<execution::SceneWatch> watch;
  };
  struct Devices;
  class Recorder;

  void work(const MotionDevices& devices, const Problem& problem, const geometric::Configuration& q,
            const std::stop_token& stop);
  void begin(std::shared_ptr<const planning::TimedPath> motion,
             std::vector<execution::MotionPart> parts, std::filesystem::path log);
  void serve(Devices& devices, const std::stop_token& stop);
  /// @returns false if a fault ended the motion.
  bool carry_out(Devices& devices, const Order& order);
  /// Runs a function on the GUI thread, later.
  template <typename F>
  void notify(F&& news);
  void set_state(State state);

  /// A motion has ended, or will not begin. @param rested whether all is at rest.
  void note_end(bool rested);

  State state_ = State::kOff;
  std::shared_ptr<execution::MotionRequests> requests_;  ///< For the running motion.
  std::shared_ptr<execution::SceneWatch> watch_;         ///< Watch of the running motion.
  bool runs_task_ = false;
  std::mutex mutex_;  ///< Guards all members below but the thread.
  std::condition_variable_any wake_;
  std::condition_variable_any ended_;
  std::stop_source motion_stop_;
  std::optional<Order> order_;
  bool moves_ = false;    ///< From run() to the motion's end.
  bool rested_ = true;    ///< The last motion ended at rest.
  bool working_ = false;  ///< The thread has not come to its end.
  std::jthread thread_;
};

}  // namespace handway::gui
