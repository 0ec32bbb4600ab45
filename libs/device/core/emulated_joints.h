#pragma once

#include <Eigen/Core>

#include <optional>

namespace handway::device {

/// Of the integration of all emulated robots, s.
inline constexpr double kEmulationStep = 1e-3;

/// Joints of an emulated device. They follow what they are commanded with a first-order lag
/// (a servo's position loop), and brake with constant deceleration.
class EmulatedJoints {
 public:
  /// @param lag time constant of the servos, s, > 0.
  /// @param deceleration of each joint in a stop, rad/s², > 0.
  EmulatedJoints(const Eigen::VectorXd& position, Eigen::VectorXd deceleration, double lag);

  /// Commands position and velocity for the next step().
  void command(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity);
  /// Brakes all joints in the same time, the shortest that their decelerations allow, and
  /// then stands, whatever was commanded; until release().
  void brake();
  void release() { braking_.reset(); }

  /// Lets `dt` (s) pass.
  void step(double dt);

  [[nodiscard]] const Eigen::VectorXd& position() const { return position_; }
  [[nodiscard]] const Eigen::VectorXd& commanded() const { return command_; }
  /// True if a joint goes faster than 1e-3 rad/s.
  [[nodiscard]] bool moving() const;

 private:
  struct Braking {
    Eigen::VectorXd from;
    Eigen::VectorXd velocity;
    double duration = 0.0;  ///< s
    double time = 0.0;      ///< s since it began
  };

  Eigen::VectorXd position_;
  Eigen::VectorXd velocity_;
  Eigen::VectorXd command_;
  Eigen::VectorXd command_velocity_;
  Eigen::VectorXd deceleration_;
  double lag_;
  std::optional<Braking> braking_;
};

}  // namespace handway::device
