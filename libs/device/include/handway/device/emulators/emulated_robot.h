#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/emulators/injected_fault.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>

namespace handway::device {

/// Build and faults of an emulated controller of joints.
struct EmulatedRobotSettings {
  JointRanges joints;
  Eigen::VectorXd position;  ///< Joint positions, rad.
  double lag = 0.01;         ///< Time constant of the servos, s.
  /// Time in which a stop brings a joint down from its full velocity, s.
  double braking_time = 0.25;
  InjectedFault fault;
};

/// An emulated controller of joints, without wires: messages are passed by calls, and so is time,
/// which never goes back. The joints follow their commands with a first-order lag (a servo's
/// position loop), and brake with constant deceleration.
class HANDWAY_DEVICE_EXPORT EmulatedRobot {
 public:
  virtual ~EmulatedRobot() = default;
  EmulatedRobot(const EmulatedRobot&) = delete;
  EmulatedRobot& operator=(const EmulatedRobot&) = delete;

  /// Simulates up to `now` (s).
  void advance(double now);

  [[nodiscard]] const Eigen::VectorXd& position() const { return position_; }
  /// Returns whether a joint is faster than 1e-3 rad/s.
  [[nodiscard]] bool moving() const;
  /// Number of stop commands received. Lost connections and timeouts don't count.
  [[nodiscard]] int stops() const { return stops_; }
  /// The fault, once it has begun.
  [[nodiscard]] FaultKind active_fault() const {
    return fault_active_ ? fault_.kind : FaultKind::kNone;
  }

 protected:
  static constexpr double kStep = 1e-3;  ///< s

  /// @throws std::invalid_argument for invalid settings.
  explicit EmulatedRobot(const EmulatedRobotSettings& settings);

  [[nodiscard]] double now() const { return now_; }  ///< s
  [[nodiscard]] JointRanges& joints() { return joints_; }
  [[nodiscard]] const JointRanges& joints() const { return joints_; }
  [[nodiscard]] const Eigen::VectorXd& commanded() const { return command_; }
  /// Commands position and velocity for this step.
  void command(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity);
  /// Brakes all joints in the same time, the shortest that their decelerations allow, and stays at
  /// rest, whatever the command; until release().
  void brake();
  void release() { braking_.reset(); }
  void count_stop() { ++stops_; }

 private:
  struct Braking {
    Eigen::VectorXd from;
    Eigen::VectorXd velocity;
    double duration = 0.0;  ///< s
    double time = 0.0;      ///< s since it began
  };

  /// Commands the joints for kStep, until now(). @returns whether a motion is running.
  virtual bool do_step() = 0;
  /// Applies active_fault() when it begins.
  virtual void do_fail() = 0;

  void follow_command();

  JointRanges joints_;
  InjectedFault fault_;
  double lag_;
  Eigen::VectorXd deceleration_;
  Eigen::VectorXd position_;
  Eigen::VectorXd velocity_;
  Eigen::VectorXd command_;
  Eigen::VectorXd command_velocity_;
  std::optional<Braking> braking_;
  double now_ = 0.0;
  double moved_ = 0.0;  ///< s since the first motion began.
  bool has_moved_ = false;
  bool fault_active_ = false;
  int stops_ = 0;
};

/// An EmulatedRobot with its ports, run by a thread of its own, for testing clients of such a
/// robot. Only this computer can connect.
class HANDWAY_DEVICE_EXPORT RobotEmulator {
 public:
  virtual ~RobotEmulator();
  RobotEmulator(const RobotEmulator&) = delete;
  RobotEmulator& operator=(const RobotEmulator&) = delete;

  /// Address for clients: "arm://localhost:11000".
  [[nodiscard]] const std::string& address() const;
  /// Present joint positions, rad.
  [[nodiscard]] Eigen::VectorXd position() const;
  [[nodiscard]] bool moving() const;
  /// Number of stop commands, see EmulatedRobot::stops().
  [[nodiscard]] int stops() const;

  class Running;

 protected:
  explicit RobotEmulator(std::unique_ptr<Running> running);

 private:
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
