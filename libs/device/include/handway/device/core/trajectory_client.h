#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/watchdog.h"
#include "handway/device/export.h"
#include "handway/geometric/io/parameter.h"

#include <Eigen/Core>

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::device {

/// State of a device's motion.
enum class MotionPhase {
  kIdle,     ///< No motion.
  kReady,    ///< Uploaded, not begun.
  kRunning,  ///< Running.
  kPaused,   ///< Paused; resume() continues.
  kDone,     ///< At its end.
  kStopped,  ///< Ended by stop().
  kFailed,   ///< Ended by a fault; see TrajectoryClient::fault().
};

/// Last measurement of a device.
struct MeasuredJoints {
  Eigen::VectorXd position;                        ///< rad, [joints]; of size 0: nothing yet.
  std::uint64_t samples = 0;                       ///< Number received.
  std::chrono::steady_clock::time_point received;  ///< Time of the last one.
};

/// Tolerances for starting a motion, and for its faults.
struct MotionTolerances {
  double start = 0.01;     ///< Largest distance of a joint from the first point at the start, rad.
  double following = 0.2;  ///< Largest following error of a joint during the motion, rad.
  double end = 0.01;       ///< Distance from the last point that counts as arrived, rad.
  /// Additional distance by which an object in the hand may keep each joint from its target, rad,
  /// [joints]; of size 0: none.
  Eigen::VectorXd give = {};

  /// Returns the distances of the joints from their targets, less `give`, rad, [joints].
  [[nodiscard]] HANDWAY_DEVICE_EXPORT Eigen::VectorXd distances(
      const Eigen::VectorXd& measured, const Eigen::VectorXd& target) const;
};

/// Describes the tolerances that users choose.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    MotionTolerances& tolerances);

/// A connection to a device that moves joints: an arm's or a hand's controller.
///
/// It has no thread of its own: its user calls update() every few milliseconds from connect()
/// on. It never lets a motion run without supervision. The motion ends with kFailed and a
/// message in fault() after a lost connection, positions that stop or come faster than they are
/// read, a refused point, an emergency stop, or a joint that does not follow or does not
/// arrive.
///
/// The public functions check; derived classes implement the device's protocol.
class HANDWAY_DEVICE_EXPORT TrajectoryClient {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~TrajectoryClient() = default;
  TrajectoryClient(const TrajectoryClient&) = delete;
  TrajectoryClient& operator=(const TrajectoryClient&) = delete;

  /// The device as the user wrote it: "arm://localhost:11000".
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const JointRanges& joints() const { return joints_; }

  /// Connects, and waits until the device has reported its joints' positions.
  /// @throws DeviceError if it can't be reached or reports none within 3 s.
  void connect(const std::stop_token& stop = {});

  /// Sends the device a motion.
  /// @throws geometric::InputError as check_trajectory(); DeviceError if it is not connected, the
  /// device doesn't accept it, or it is moving.
  void upload(const JointTrajectory& trajectory, const std::stop_token& stop = {});

  /// Starts the uploaded motion.
  /// @throws DeviceError with the reason why the device can't move now, or the joint that is too
  /// far from the first point; nothing moves then.
  void start(const MotionTolerances& tolerances = {});

  /// Pauses the motion as soon as the device can, but not before `time` (s of the motion). Nothing
  /// happens if it isn't running. Any error ends the motion with kFailed.
  /// @returns the motion's time of the pause: for other devices that have to pause there.
  double pause(double time = 0.0);
  /// Continues a paused motion, otherwise nothing happens. Any error ends the motion with
  /// kFailed.
  void resume();

  /// Stops the joints as fast as the device can, and discards the motion. Never throws: if the
  /// device can't be reached any more its own watchdog stops it.
  void stop();

  /// Polls the device: reads its state, sends due points, checks for faults. Waits 2 ms at most,
  /// and reads at most 256 KiB and 5 ms from each of its connections, however much the device
  /// sends: the rest waits for the next call. Any error, an exception included, ends the motion
  /// with kFailed.
  void update();

  [[nodiscard]] MotionPhase phase() const { return phase_; }
  [[nodiscard]] const std::string& fault() const { return fault_; }  ///< Empty: none.
  [[nodiscard]] const MeasuredJoints& measured() const { return measured_; }
  /// Time of the motion without pauses, s.
  [[nodiscard]] double motion_time(Clock::time_point now) const;
  [[nodiscard]] const JointTrajectory& trajectory() const { return trajectory_; }

 protected:
  TrajectoryClient(std::string name, JointRanges joints);

  /// For derived classes: stores new positions. @pre shape [joints].
  void add_sample(const Eigen::VectorXd& position);
  /// For derived classes. @throws DeviceError with this link's name.
  [[noreturn]] void refuse(std::string found, std::string expected, std::string advice) const;

 private:
  virtual void do_connect(const std::stop_token& stop) = 0;
  virtual void do_upload(const JointTrajectory& trajectory, const std::stop_token& stop) = 0;
  /// @throws DeviceError if the device can't move now.
  virtual void do_start() = 0;
  /// @param time earliest pause, s. @returns the time of the pause, s.
  [[nodiscard]] virtual double do_pause(double time) = 0;
  virtual void do_resume() = 0;
  virtual void do_stop() = 0;
  /// Reads within a ReadBudget. @param time of the motion, s. @returns whether all pending bytes
  /// were read. @throws DeviceError for anything that has to end the motion.
  [[nodiscard]] virtual bool do_update(double time) = 0;

  void take_turn(double time);
  void fail(std::string fault);
  bool send_stop();
  void look_at_sample();
  void look_at_end(Clock::time_point now);

  std::string name_;
  JointRanges joints_;
  bool connected_ = false;
  MotionPhase phase_ = MotionPhase::kIdle;
  std::string fault_;
  MeasuredJoints measured_;
  Watchdog watchdog_;
  Backlog backlog_;
  std::uint64_t samples_seen_ = 0;
  JointTrajectory trajectory_;
  MotionTolerances tolerances_;
  Clock::time_point begin_;  ///< Start of motion time, shifted by the pauses.
  double hold_ = 0.0;        ///< Motion time of the pause, s.
};

}  // namespace handway::device
