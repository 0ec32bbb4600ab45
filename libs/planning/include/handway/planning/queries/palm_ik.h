#pragma once

#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// Result of moving the palm of an arm to a pose.
struct PalmMove {
  Configuration q;       ///< Whole robot, within limits.
  bool reached = false;  ///< Within 0.1 mm and 0.01°; for few joints the place alone.
};

/// Moves an arm so that the palm goes to a pose, with the fingers unchanged: in closed form if the
/// arm has one, otherwise iteratively. Const and for any number of threads.
class HANDWAY_PLANNING_EXPORT PalmIk {
 public:
  /// @param palm a link that the arm moves. @param arm its variables, at least one.
  /// @throws InputError if none of them moves the palm.
  PalmIk(std::shared_ptr<const geometric::RobotModel> model, int palm,
         const geometric::JointIndices& arm);
  ~PalmIk();
  PalmIk(PalmIk&&) noexcept;

  [[nodiscard]] int palm() const { return palm_; }
  /// Pose X_BP of the palm in the robot's base.
  [[nodiscard]] geometric::Pose pose(const Configuration& q) const;

  /// The arm posture nearest to `q` that brings the palm to X_BP. If out of reach: one with the
  /// palm as near as iterations from `q` get it.
  /// @throws InputError if X_BP is no rigid transform or `q` not a configuration.
  [[nodiscard]] PalmMove moved(const Configuration& q, const geometric::Pose& X_BP) const;

  /// Postures of an arm without closed form that all() returns at most.
  static constexpr int kMostPostures = 4;

  /// Arm postures that reach X_BP, nearest to `q` first: one for each branch, or, without a closed
  /// form, the first `most` that are found by iterations with several starts. Same arguments, same
  /// bits.
  [[nodiscard]] std::vector<Configuration> all(const Configuration& q, const geometric::Pose& X_BP,
                                               int most = kMostPostures) const;

  /// Returns whether the arm has a null space: more joints than the palm's pose needs.
  [[nodiscard]] bool is_redundant() const;

  /// Moves a redundant arm in its null space, with the palm at X_BP: its elbow swings. Ends at the
  /// first limit.
  /// @param X_BP pose of the palm in `q`. @param by length of the joints' motion, rad; its sign is
  /// the direction.
  /// @param direction shape [joints that move the palm]; empty at first. Set to the final
  /// direction, for calls that continue from there.
  /// @returns `q` itself for an arm that is not redundant.
  [[nodiscard]] Configuration swung(const Configuration& q, const geometric::Pose& X_BP, double by,
                                    Eigen::VectorXd& direction) const;

 private:
  /// The direction of unit length in the null space at `q` that is nearest to `last`; empty without
  /// a null space.
  [[nodiscard]] Eigen::VectorXd null_space_direction(const Configuration& q,
                                                     const Eigen::VectorXd& last) const;

  std::shared_ptr<const geometric::RobotModel> model_;
  int palm_;
  geometric::JointIndices arm_;
  std::unique_ptr<geometric::InverseKinematics> closed_form_;       ///< Null: not available.
  std::unique_ptr<geometric::NumericInverseKinematics> iterative_;  ///< Starts at the posture.
  std::unique_ptr<geometric::NumericInverseKinematics> searching_;  ///< From other starts, too.
};

/// Manipulability and reach of an arm that holds a link.
struct ReachFigures {
  /// Yoshikawa's measure for the link's origin, of metres per radian (geometric::manipulability()):
  /// 0 if the arm can't move it in some direction.
  double manipulability = 0.0;
  /// Distance of the link's origin from the arm's first joint, as a share of the bound by the links
  /// between (geometric::reach_ball()); 1 is not always reached.
  double reach = 0.0;
};

/// @param arm variables. Nothing if none of them moves the link.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<ReachFigures> reach_figures(
    const geometric::RobotModel& model, int link, const geometric::JointIndices& arm,
    const Configuration& q);

/// The middle of a link's shape, in its frame, m; its origin if it has none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::Vector3d middle_of(const geometric::Link& link);

}  // namespace handway::planning
