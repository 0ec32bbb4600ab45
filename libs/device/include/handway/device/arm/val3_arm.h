#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/trajectory_client.h"
#include "handway/device/export.h"

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

/// Ranges and nominal speeds of the Staeubli TX90's six joints.
/// Source: Staeubli, TX90 data sheet.
[[nodiscard]] HANDWAY_DEVICE_EXPORT JointRanges tx90_joints();

/// Port of motions of the VAL3 server; it reports the state on the port two above.
inline constexpr std::uint16_t kVal3MotionPort = 11000;

/// An arm on a Staeubli CS8 or CS9 controller that runs the VAL3 server of ROS-Industrial
/// (ros-industrial/staubli_val3_driver, VAL3 s7.7.2 or later).
///
/// The controller has no clock: it moves to one point after the other, each at a share of its
/// joints' nominal velocities, from a queue of ten points. The client keeps the motion's time: it
/// sends points ahead by less than the queue holds, each with the share that reaches it in its
/// time. Where the arm has to wait, it sends the next point after the wait.
class HANDWAY_DEVICE_EXPORT Val3Arm final : public TrajectoryClient {
 public:
  /// @param name for messages. @param port of motions.
  /// @param joints in the controller's order, with its nominal velocities; ten at most.
  Val3Arm(std::string name, std::string host, std::uint16_t port, JointRanges joints);
  ~Val3Arm() override;

 private:
  void do_connect(const std::stop_token& stop) override;
  void do_upload(const JointTrajectory& trajectory, const std::stop_token& stop) override;
  void do_start() override;
  [[nodiscard]] double do_pause(double time) override;
  void do_resume() override;
  void do_stop() override;
  [[nodiscard]] bool do_update(double time) override;

  void send_due_point(double time);
  [[nodiscard]] bool read_feedback();
  void look_at_status() const;
  [[nodiscard]] bool read_replies();
  void take_reply(bool taken);

  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace handway::device
