#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/collision/motion_bound.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::geometric {

/// How far the bodies of a pair move against each other on a part of one edge:
/// MotionBound, sharpened by how they really move in the part's middle.
///
/// Where several joints turn at once their motions largely cancel out. A point's
/// velocity in the middle is known; on the way to either end it changes by no
/// more than the joints turn each other's axes. Both together bound the way.
class HANDWAY_GEOMETRIC_EXPORT EdgeMotion {
 public:
  explicit EdgeMotion(std::shared_ptr<const MotionBound> motion);

  /// The edge: how much each variable changes from one end to the other.
  void set_edge(const Configuration& delta);

  /// A configuration on the edge. @param X_BL its link poses, in the robot's base.
  void set_middle(const std::vector<Pose>& X_BL);

  /// MotionBound's bound (m) of the change of the pair's distance over the whole edge.
  [[nodiscard]] double over_edge(int pair) const { return travel_[motion_->motion(pair)]; }

  /// The most (m) that any pair has over the edge.
  [[nodiscard]] double most_over_edge() const { return most_; }

  /// Upper bound (m) of the change of the pair's distance between the middle and
  /// any configuration of the edge at most `half` of the edge away from it.
  [[nodiscard]] double within(int pair, double half) const;

 private:
  /// Of a body against the link `frame`.
  [[nodiscard]] double way(int body, int frame, double half) const;

  std::shared_ptr<const MotionBound> motion_;
  Eigen::VectorXd travel_;  ///< Per motion.
  double most_ = 0.0;
  std::vector<double> rates_;          ///< Per link: its joint's change, rad or m.
  std::vector<Eigen::Vector3d> w_BL_;  ///< Per link: angular velocity in the base, rad per edge.
  std::vector<Eigen::Vector3d> v_BL_;  ///< Per link: velocity of its frame's origin, m per edge.
  const std::vector<Pose>* X_BL_ = nullptr;
};

}  // namespace handway::geometric
