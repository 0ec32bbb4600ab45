#pragma once

#include "handway/device/emulators/device_emulator.h"
#include "handway/device/tracker/tool_follower.h"
#include "handway/device/tracker/tracker.h"
#include "handway/geometric/robot/robot_description.h"
#include "model/devices/stream_link.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// A tracker's stream brought to the window's thread.
class TrackerLink : public DeviceLink<device::Tracker, device::TrackerSample> {
  Q_OBJECT

 public:
  using DeviceLink::DeviceLink;

  /// Replaces the stream.
  /// @param emulator that the tracker talks to, kept as long; may be null.
  void start(std::unique_ptr<device::Tracker> tracker,
             std::unique_ptr<device::DeviceEmulator> emulator = nullptr);

 signals:
  /// Samples of all sensors since the last time, oldest first, never none.
  void arrived(const std::vector<handway::device::TrackerSample>& samples);
};

/// The wrist tracker that the workbench listens to.
class TrackerSession : public QObject {
  Q_OBJECT

 public:
  explicit TrackerSession(QObject* parent = nullptr);
  ~TrackerSession() override;

  /// Returns the protocols of trackers as they are written before an address; "emulator", the
  /// built-in one, has none.
  [[nodiscard]] static QStringList protocols();

  /// Connects to "emulator", "fastrak:/dev/ttyUSB0", "liberty:HOST:PORT" or "udp:5005". Errors are
  /// reported by state_changed().
  void connect_to(const QString& device);
  void disconnect_tracker();
  /// Returns the argument of the last connect_to(); empty before.
  [[nodiscard]] const QString& device() const { return device_; }
  [[nodiscard]] TrackerLink& link() { return link_; }

 signals:
  void state_changed(handway::device::StreamState state, const QString& error);
  /// Samples of all sensors since the last time, oldest first.
  void sampled(const std::vector<handway::device::TrackerSample>& samples);

 private:
  void start(const QString& protocol, const QString& address);

  TrackerLink link_;
  QString device_;
};

/// Leads the arm by a tracked wrist: the clutch, and a follower that starts again where the robot
/// is whenever it is closed.
class ArmLeader : public QObject {
  Q_OBJECT

 public:
  explicit ArmLeader(QObject* parent = nullptr);

  /// @param model null: no robot. @param arm variables of its arm, in order.
  /// @param q where it is.
  void set_robot(const std::shared_ptr<const geometric::RobotModel>& model,
                 const std::vector<int>& arm, const geometric::Configuration& q);
  /// Returns the reason why the arm can't be led; empty if it can.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Changes the settings at once: a closed clutch engages again.
  void set_settings(const device::ToolFollowerSettings& settings);
  [[nodiscard]] const device::ToolFollowerSettings& settings() const { return settings_; }
  void set_configuration(const geometric::Configuration& q) { q_ = q; }
  /// Returns the position of the tool in the robot's base; nothing without an arm.
  [[nodiscard]] std::optional<Eigen::Vector3d> tool_position() const;

  void set_clutch(bool closed);
  [[nodiscard]] bool is_clutch_closed() const { return closed_; }

  /// A sample of the sensor that leads.
  void take(const device::TrackerSample& sample);

 signals:
  /// The arm's joints are to be there.
  void wanted(const handway::geometric::NamedPosture& posture);
  void clutch_changed(bool closed);
  /// Emitted after every sample and change with the state of following.
  void followed(const handway::device::FollowStep& step);

 private:
  void take_hold();

  std::shared_ptr<const geometric::InverseKinematics> ik_;
  std::vector<std::string> joints_;  ///< Names of ik_->variables().
  QString problem_;
  device::ToolFollowerSettings settings_;
  geometric::Configuration q_;
  std::optional<device::ToolFollower> follower_;  ///< While the clutch is closed.
  bool closed_ = false;
};

}  // namespace handway::gui
