#pragma once

#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::device {

/// Returns -1 for negative values, else 1.
[[nodiscard]] inline double sign_of(double value) { return value < 0.0 ? -1.0 : 1.0; }

/// Returns whether the joint that carries `link` moves it: a joint without a range is a fixed
/// joint.
[[nodiscard]] bool joint_moves(const geometric::RobotModel& model, int link);

/// Poses and points of a hand in the frame of its palm.
class PalmKinematics {
 public:
  /// @param model must outlive this object.
  PalmKinematics(const geometric::RobotModel& model, int palm)
      : model_(model), palm_(palm), X_BL_(static_cast<std::size_t>(model.link_count())) {}

  [[nodiscard]] const geometric::RobotModel& model() const { return model_; }
  [[nodiscard]] int palm() const { return palm_; }
  [[nodiscard]] geometric::Pose pose(int link, const geometric::Configuration& q);
  [[nodiscard]] Eigen::Vector3d point(int link, const Eigen::Vector3d& p_L,
                                      const geometric::Configuration& q) {
    return pose(link, q) * p_L;
  }
  [[nodiscard]] Eigen::Vector3d tip(const RobotFinger& finger, const geometric::Configuration& q) {
    return point(finger.tip_link, finger.p_LT, q);
  }

 private:
  const geometric::RobotModel& model_;
  int palm_;
  std::vector<geometric::Pose> X_BL_;
};

/// Bending of a finger by its joints, in the palm's frame: by those that turn about the axis that
/// most of its joints have in common.
struct FingerBend {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();     ///< Unit vector, or zero if nothing bends it.
  Eigen::Vector3d knuckle = Eigen::Vector3d::Zero();  ///< Position of the first bending joint, m.
  /// The finger's variables with aligned phalanges, rad: shape [variables].
  std::vector<double> straight;
  /// Rotation of all phalanges about the axis for each variable: shape [variables], 0 for one that
  /// does not bend the finger.
  std::vector<double> rates;
  std::vector<bool> is_at_knuckle;  ///< True if a variable bends the finger at its knuckle alone.
  /// Asymmetry of the joints' ranges about the axis, seen from the straight finger: 1 if they only
  /// bend it one way, -1 the other way, 0 both ways equally.
  double asymmetry = 0.0;

  [[nodiscard]] bool bends() const { return !axis.isZero(); }
  void reverse();
};

/// @param finger with variables, tip and first joint. @param chain its links from the palm on.
[[nodiscard]] FingerBend bend_of(PalmKinematics& palm, const std::vector<int>& chain,
                                 const RobotFinger& finger);

/// Decides to which side each finger closes, and turns the axes of `bends` so that positive angles
/// close it. Fingers side by side close to the same side. The evidence is the side of the larger
/// joint ranges, seen from the straight finger, and the side on which the fingers come nearer to
/// the whole workspace of the thumb (for fingers that are not side by side: of the others).
/// @param fingers the thumb, if any, is known. @param bends one per finger.
/// @returns doubts, as sentences.
[[nodiscard]] std::vector<std::string> find_closing_sides(PalmKinematics& palm,
                                                          const std::vector<RobotFinger>& fingers,
                                                          std::vector<FingerBend>& bends);

}  // namespace handway::device
