#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// A robot in one configuration at one place: the changing part beside the RobotModel.
/// Use one per thread. Link poses are always up to date, so that reading is const and
/// cheap.
class HANDWAY_GEOMETRIC_EXPORT RobotState {
 public:
  /// Starts in the model's neutral configuration. @pre model is not null.
  explicit RobotState(std::shared_ptr<const RobotModel> model, const Pose& X_WB = Pose::Identity());

  [[nodiscard]] const RobotModel& model() const { return *model_; }
  [[nodiscard]] const std::shared_ptr<const RobotModel>& shared_model() const { return model_; }

  /// Pose of the robot's base (root link) in the world.
  [[nodiscard]] const Pose& base_pose() const { return X_WB_; }

  /// Shape [variable_count], rad or m. Limits are not enforced: see within_limits().
  [[nodiscard]] const Configuration& configuration() const { return q_; }
  /// @throws InputError if the size differs or a value is not finite.
  void set_configuration(const Configuration& q);

  /// Sets one variable, rad or m.
  /// @throws InputError if no variable has this name (a coupled joint follows
  /// its leader and can't be set) or the value is not finite.
  void set_joint(std::string_view joint_name, double value);
  /// Sets the joints that the posture names, leaving the others.
  /// @throws InputError as set_joint; then nothing has changed.
  void set_posture(const NamedPosture& posture);
  /// Value of any moving joint, coupled ones included, rad or m.
  /// @throws InputError if no moving joint has this name.
  [[nodiscard]] double joint_value(std::string_view joint_name) const;

  /// Returns whether every joint is in its limits: see limit_violations().
  [[nodiscard]] bool within_limits() const;

  /// Pose X_WL of a link in the world. @pre 0 ≤ link < model().link_count().
  [[nodiscard]] const Pose& link_pose(int link) const {
    return X_WL_[static_cast<std::size_t>(link)];
  }
  /// @throws InputError if the robot has no such link.
  [[nodiscard]] const Pose& link_pose(std::string_view link_name) const;
  /// Poses of all links, shape [link_count].
  [[nodiscard]] std::span<const Pose> link_poses() const { return X_WL_; }

 private:
  void update();

  std::shared_ptr<const RobotModel> model_;
  Pose X_WB_;
  Configuration q_;
  std::vector<Pose> X_WL_;
};

}  // namespace handway::geometric
