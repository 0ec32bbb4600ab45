#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/planning/tasks/palm_line.h"
#include "task_world.h"

#include <Eigen/Core>

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// The hand that grasps, on its arm.
class GraspingHand {
 public:
  /// The joints of an arm and of the hand that it carries.
  struct ArmAndHand {
    geometric::JointIndices arm;
    geometric::JointIndices hand;
    geometric::HandStructure structure;
  };

  /// @param palm link of the hand, from Pregrasps::palm.
  GraspingHand(const PlanningProblem& problem, int palm);

  [[nodiscard]] std::string palm_name() const;
  /// Names of the joints of the arm.
  [[nodiscard]] std::vector<std::string> arm_names() const;
  /// Names of palm and finger links: those that may touch what they grasp.
  [[nodiscard]] const std::vector<std::string>& links() const { return links_; }

  /// Pose X_WP of the palm in the world.
  [[nodiscard]] geometric::Pose palm_pose(const Configuration& q) const;
  /// Returns `q` with the hand's joints of `posture`.
  [[nodiscard]] Configuration with_hand(const Configuration& q, const Configuration& posture) const;
  /// Returns the arm postures that bring the palm to X_WP, nearest to `q` first; the fingers stay.
  [[nodiscard]] std::vector<Configuration> reach(const Configuration& q,
                                                 const geometric::Pose& X_WP) const;
  /// Moves the palm along a straight line. @param shift_W in the world, m.
  [[nodiscard]] PalmLine line(const Configuration& q, const Eigen::Vector3d& shift_W) const;

  /// A motion between a pre-grasp and a place beside the object.
  struct WayOut {
    Path path;
    double deviation = 0.0;  ///< See PalmLine::deviation.
    std::string fault;       ///< Fault of the first way that was tried, if none is free.
    Configuration shown;     ///< A configuration that shows it.
  };
  /// Finds a way from a pre-grasp, or to it: the fingers open, as little as possible, and the palm
  /// moves straight away from the object, back along the fingers, or upwards.
  /// @param q with the palm and the fingers of the pre-grasp. @param object_W middle of the object.
  /// @param length of the straight line, m. @param inwards true: it ends at `q`.
  [[nodiscard]] WayOut way_out(const TaskWorld& world, const Pregrasp& grasp,
                               const Configuration& q, const Eigen::Vector3d& object_W,
                               double length, bool inwards, const std::stop_token& stop) const;

 private:
  GraspingHand(const PlanningProblem& problem, int palm, const ArmAndHand& found);
  /// Returns `q` with the fingers opened against the direction in which the grasp closes them, by a
  /// share of the joints' ranges.
  [[nodiscard]] Configuration opened(const Configuration& q, const Pregrasp& grasp,
                                     double share) const;
  /// Directions in which the hand may leave the object, in the world, of length 1.
  [[nodiscard]] std::vector<Eigen::Vector3d> directions(const Configuration& q,
                                                        const Eigen::Vector3d& object_W) const;

  std::shared_ptr<const geometric::RobotModel> model_;
  geometric::Pose X_WB_;
  geometric::JointIndices arm_;
  geometric::JointIndices hand_;
  geometric::LinkIndices tips_;
  std::vector<std::string> links_;
  PalmIk ik_;
};

}  // namespace handway::planning
