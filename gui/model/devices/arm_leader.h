#pragma once

#include "handway/device/tracker/tool_follower.h"
#include "handway/geometric/robot/robot_description.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// Leads the arm by a tracked wrist: the clutch, and a follower that begins anew where the robot is
/// whenever it is closed.
class ArmLeader : public QObject {
  Q_OBJECT

 public:
  explicit ArmLeader(QObject* parent = nullptr);

  /// @param model null: no robot. @param arm variables of its arm, in order.
  /// @param q where it is.
  void set_robot(const std::shared_ptr<const geometric::RobotModel>& model,
                 const std::vector<int>& arm, const geometric::Configuration& q);
  /// Why there is nothing to lead; empty if there is.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Takes effect at once: a closed clutch takes hold anew.
  void set_settings(const device::ToolFollowerSettings& settings);
  [[nodiscard]] const device::ToolFollowerSettings& settings() const { return settings_; }
  void set_configuration(const geometric::Configuration& q) { q_ = q; }
  /// Where the tool is in the robot's base; nothing without an arm.
  [[nodiscard]] std::optional<Eigen::Vector3d> tool_position() const;

  void set_clutch(bool closed);
  [[nodiscard]] bool is_clutch_closed() const { return closed_; }

  /// A sample of the sensor that leads.
  void take(const device::TrackerSample& sample);

 signals:
  /// The arm's joints are to be there.
  void wanted(const handway::geometric::NamedPosture& posture);
  void clutch_changed(bool closed);
  /// How the arm follows, after every sample and change.
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
