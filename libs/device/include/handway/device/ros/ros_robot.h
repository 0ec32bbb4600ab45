#pragma once

#include "handway/device/core/trajectory_client.h"
#include "handway/device/export.h"
#include "handway/device/ros/rosbridge.h"

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

/// Port of rosbridge servers.
inline constexpr std::uint16_t kRosbridgePort = 9090;

/// Address of a robot.
struct RosAddress {
  std::string host;
  std::uint16_t port = kRosbridgePort;
  RosVersion version = RosVersion::kRos1;
  /// Topic of the `trajectory_msgs/JointTrajectory` of its controller.
  std::string trajectory_topic = "/joint_trajectory_controller/command";
};

/// Topics on which a robot reports its joints' positions and its state.
inline constexpr const char* kJointStatesTopic = "/joint_states";
/// Topic on which a robot reports its state (industrial_msgs/RobotStatus).
inline constexpr const char* kRobotStatusTopic = "/robot_status";

/// The topic on which the joint_trajectory_controller of that name receives motions.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string trajectory_topic(const std::string& controller,
                                                                 RosVersion version);

/// A robot in ROS 1 or ROS 2 with a joint_trajectory_controller (ros_controllers, ros2_controllers)
/// behind a rosbridge server.
///
/// A controller in ROS continues its motion when its client is gone. So it never gets more than the
/// next 0.2 s, and 0.25 s more in which it brakes on the planned path; every 50 ms the next stretch
/// replaces the last. Positions come from kJointStatesTopic, from one publisher or several. Reports
/// on kRobotStatusTopic (industrial_msgs/RobotStatus) are evaluated if they are published: ROS has
/// no status that all robots report.
class HANDWAY_DEVICE_EXPORT RosRobot final : public TrajectoryClient {
 public:
  /// @param name for messages. @param joints that the controller moves, by their names in ROS.
  RosRobot(std::string name, RosAddress address, JointRanges joints);
  ~RosRobot() override;

  /// Sends the joints to `position` (rad) within `time` (s), from their present motion: for motions
  /// that are not known in advance. Call it, and update(), every few ten milliseconds; the robot
  /// rests at the last position when no more come.
  /// @throws InputError for positions out of range, or if a joint is so far behind that it would
  /// exceed its velocity limit; DeviceError after a fault(), an uploaded motion, or if the robot
  /// can't move.
  void lead(const Eigen::VectorXd& position, double time);

 private:
  void do_connect(const std::stop_token& stop) override;
  void do_upload(const JointTrajectory& trajectory, const std::stop_token& stop) override;
  void do_start() override;
  [[nodiscard]] double do_pause(double time) override;
  void do_resume() override;
  void do_stop() override;
  [[nodiscard]] bool do_update(double time) override;

  [[nodiscard]] bool read();
  void take(const RosbridgeMessage& message);
  void take_joints(const RosJointState& state);
  void send_window(double time, double follow, double brake);
  void publish_motion(const RosTrajectory& motion);

  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace handway::device
