#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/tracker.h"
#include "handway/geometric/io/parameter.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <Eigen/Geometry>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {

/// Limits of a tool's position: a box and a ball, both in the robot's base frame B, m. By default
/// everywhere.
struct WorkspaceLimits {
  Eigen::AlignedBox3d box{Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                          Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  Eigen::Vector3d reach_centre = Eigen::Vector3d::Zero();  ///< Such as the arm's shoulder.
  double reach = std::numeric_limits<double>::infinity();  ///< Radius of the ball.
};

/// @throws std::invalid_argument if the box is empty, the reach isn't above 0, a number is not a
/// number, or box and ball have no point in common.
HANDWAY_DEVICE_EXPORT void check_workspace(const WorkspaceLimits& limits);

/// Returns `point` if it is inside, else a point of the limits' surface near to it; within 1e-6 m.
/// @param point m, finite. @pre check_workspace(limits) passes.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Eigen::Vector3d nearest_inside(const WorkspaceLimits& limits,
                                                                   const Eigen::Vector3d& point);

/// Scale, limits and smoothing of a ToolFollower.
struct ToolFollowerSettings {
  /// Orientation of the tracker's source S in the robot's base B.
  Eigen::Matrix3d R_BS = Eigen::Matrix3d::Identity();
  double translation_scale = 1.0;  ///< Motion of the tool per motion of the hand.
  bool rotate = true;              ///< True: the tool turns with the hand.
  WorkspaceLimits workspace;       ///< Limits of the tool's origin.
  double smoothing = 0.05;         ///< Time constant of the first-order low-pass, s; 0: none.
  double top_speed = 1.0;  ///< Speed limit of every joint, rad/s or m/s, besides the model's.
  /// A posture that differs by more than this from the last one in some joint, rad or m, is on
  /// another branch: it is not followed.
  double largest_branch_step = 0.8;
  double longest_gap = 0.5;  ///< Between two samples, s; after a longer one the clutch opens.
};

/// Describes the settings of the motion, but the orientation of the source.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    ToolFollowerSettings& settings);

/// State of a ToolFollower after a sample.
enum class FollowState {
  kReleased,    ///< The clutch is open: the robot is at rest.
  kFollowing,   ///< The tool follows the hand.
  kSlowed,      ///< Moving there, as fast as allowed.
  kOutOfReach,  ///< No posture within limits reaches it: the robot rests.
  kBranchEnd,   ///< Only a posture far from the present one reaches it: the robot rests.
};

/// Result of following one sample.
struct FollowStep {
  FollowState state = FollowState::kReleased;
  geometric::Configuration q;  ///< Command for the robot, shape [model().variable_count()].
  geometric::Pose X_BF = geometric::Pose::Identity();  ///< Target pose of the tool F.
  bool at_workspace_edge = false;                      ///< The target was beyond the edge.
  std::string reason;                                  ///< Reason for standing; else empty.
};

/// Moves an arm's tool with a tracked wrist. While the clutch is closed, the tool makes the
/// sensor's motion since the closing: the same rotation, and the same displacement times a scale,
/// both in the directions of the base. The target pose is kept within the workspace, smoothed,
/// and reached in the posture nearest to the last. No joint ever exceeds its velocity limit,
/// whatever the samples. Obstacles are ignored: the code that moves a real arm checks for
/// collisions.
class HANDWAY_DEVICE_EXPORT ToolFollower {
 public:
  /// @param ik for the tool's link; @pre not null.
  /// @param q the present configuration, shape [ik->model().variable_count()].
  /// @throws std::invalid_argument if q's size, a setting or a number is invalid.
  ToolFollower(std::shared_ptr<const geometric::InverseKinematics> ik, geometric::Configuration q,
               const ToolFollowerSettings& settings = {});

  /// Closes the clutch: from the next sample on the tool moves with the sensor.
  void engage() { engaged_ = true; }
  /// Opens the clutch: the robot rests.
  void disengage();
  [[nodiscard]] bool engaged() const { return engaged_; }

  /// Takes a sample of one sensor. @returns the command for the robot.
  /// @pre the pose is finite and rigid, as those of Tracker::next().
  FollowStep update(const TrackerSample& sample);

  [[nodiscard]] const geometric::Configuration& configuration() const { return q_; }
  /// Pose of the tool's frame F in the base at configuration().
  [[nodiscard]] geometric::Pose tool_pose() const;

 private:
  /// Poses of sensor and tool when the clutch was closed.
  struct Grip {
    geometric::Pose X_ST;
    geometric::Pose X_BF;
  };

  [[nodiscard]] geometric::Pose wanted_pose(const geometric::Pose& X_ST) const;
  void smooth(const geometric::Pose& wanted, double dt);
  void follow(double dt, FollowStep& step);

  std::shared_ptr<const geometric::InverseKinematics> ik_;
  ToolFollowerSettings settings_;
  Eigen::VectorXd top_speeds_;                          ///< Shape [ik->variables().size()].
  geometric::Configuration q_;                          ///< Present command.
  geometric::Configuration goal_;                       ///< Present target.
  geometric::Pose X_BF_ = geometric::Pose::Identity();  ///< Smoothed.
  std::optional<Grip> grip_;
  bool engaged_ = false;
  double last_time_ = 0.0;
};

}  // namespace handway::device
