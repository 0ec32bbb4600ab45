#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/collision/point_motion.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::geometric {

/// Bound of the relative motion of two bodies of a pair as the joints move: the farthest that any
/// point of one can travel in the frame of the other per unit of each variable, over all
/// configurations. Couplings are included. For a constraint (see CollisionWorld::constraints()) it
/// bounds the travel of its point, or the rotation of its axis (rad).
///
/// Source: Schwarzer, Saha, Latombe, "Adaptive dynamic collision checking for
/// single and multiple articulated robots in complex environments", IEEE
/// Transactions on Robotics 21(3), 2005.
class HANDWAY_GEOMETRIC_EXPORT MotionBound {
 public:
  explicit MotionBound(const CollisionWorld& world);

  /// Upper bound (m) of the change of the pair's distance when every variable v
  /// moves by at most `travel[v]`. @param travel shape [variable_count], ≥ 0.
  [[nodiscard]] double bound(int pair, const Eigen::VectorXd& travel) const {
    return reach_.row(motion(pair)).dot(travel);
  }

  /// Pairs with the same relative motion share it: those of one body with all fixed bodies.
  /// Constraints have a motion each, after those of the pairs.
  [[nodiscard]] int motion(int pair) const { return motions_[static_cast<std::size_t>(pair)]; }

  /// Number of motions of pairs: those of constraints follow.
  [[nodiscard]] Eigen::Index pair_motions() const { return pair_motions_; }
  /// Number of motions of pairs and constraints.
  [[nodiscard]] std::size_t motion_count() const { return static_cast<std::size_t>(reach_.rows()); }

  /// bound() of all motions. @returns shape [motions].
  [[nodiscard]] Eigen::VectorXd bounds(const Eigen::VectorXd& travel) const;

  /// Bounds the motion of any point of the robot in the world: the measure of edge resolution in
  /// millimetres.
  [[nodiscard]] double any_point(const Eigen::VectorXd& travel) const {
    return farthest_.dot(travel);
  }

  [[nodiscard]] const RobotModel& model() const { return *model_; }
  [[nodiscard]] const Pose& X_WB() const { return X_WB_; }

  /// Frame in which a pair's motion is measured.
  struct PairFrame {
    int a = 0;  ///< Bodies of the pair.
    int b = 0;
    int link = 0;  ///< The closest common ancestor of their links.
    bool b_moves = false;
  };
  [[nodiscard]] const PairFrame& pair_frame(int pair) const {
    return frames_[static_cast<std::size_t>(pair)];
  }

  /// A ball around a body, in the frame of its link. Constraints are numbered after the bodies:
  /// they have a point, or a direction, whose "centre" is a unit vector.
  struct Ball {
    int link = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;
    bool is_direction = false;
  };
  [[nodiscard]] const Ball& ball(int body) const { return balls_[static_cast<std::size_t>(body)]; }

  /// The farthest that a point of `body` can travel per unit of the joint of `link`, over all
  /// configurations: m per rad, or 1. 0: the joint does not move it.
  [[nodiscard]] double reach(int link, int body) const { return of_link_(link, body); }

 private:
  /// Motions of bodies against each other, by their columns of `reach_`.
  using MotionIndices = std::vector<int>;

  std::shared_ptr<const RobotModel> model_;
  Pose X_WB_;
  std::vector<PairFrame> frames_;
  std::vector<Ball> balls_;
  Eigen::MatrixXd of_link_;  ///< Shape [link_count x bodies].
  MotionIndices motions_;    ///< Per pair.
  Eigen::Index pair_motions_ = 0;
  Eigen::MatrixXd reach_;     ///< Shape [motions x variable_count], m per rad or m per m.
  Eigen::VectorXd farthest_;  ///< Shape [variable_count].
};

/// Bound of the relative motion of a pair's bodies on a part of one edge: MotionBound, sharpened by
/// how they really move in the part's middle.
///
/// If several joints turn at once, their motions largely cancel out. A point's velocity in the
/// middle is known; its change up to either end is bounded by the joints' rotation of each other's
/// axes. Both together bound the displacement.
class HANDWAY_GEOMETRIC_EXPORT EdgeMotion {
 public:
  explicit EdgeMotion(std::shared_ptr<const MotionBound> motion);

  /// The edge: the change of each variable from one end to the other.
  void set_edge(const Configuration& delta);

  /// A configuration on the edge. @param X_BL its link poses, in the robot's base.
  void set_middle(const std::vector<Pose>& X_BL);

  /// MotionBound's bound (m) of the change of the pair's distance over the whole edge.
  [[nodiscard]] double over_edge(int pair) const { return travel_[motion_->motion(pair)]; }

  /// The largest bound (m) of any pair over the edge.
  [[nodiscard]] double most_over_edge() const { return most_; }

  /// Upper bound (m) of the change of the pair's distance between the middle and any configuration
  /// of the edge within `half` of the edge.
  [[nodiscard]] double within(int pair, double half);

  /// The motions of the pair's bodies about the middle, in the world.
  [[nodiscard]] PairMotion pair_motion(int pair) const;

 private:
  /// The motion of a body about the middle, seen from the link `frame`, in the world.
  [[nodiscard]] PointMotion point_motion(int body, int frame) const;
  /// Bounds the second derivative of a body's points relative to the link `frame`, m per edge².
  [[nodiscard]] double bend(int body, int frame) const;
  /// Bounds the speed of a body's points relative to the link `frame` in the middle, m per edge.
  [[nodiscard]] double speed(int body, int frame) const;

  std::shared_ptr<const MotionBound> motion_;
  Eigen::VectorXd travel_;  ///< Per motion.
  double most_ = 0.0;
  std::vector<double> bends_;          ///< Per motion, of both bodies; negative: not known yet.
  std::vector<double> speeds_;         ///< Per motion in this middle, of both bodies; as above.
  std::vector<double> rates_;          ///< Per link: its joint's change, rad or m.
  std::vector<Eigen::Vector3d> w_BL_;  ///< Per link: angular velocity in the base, rad per edge.
  std::vector<Eigen::Vector3d> v_BL_;  ///< Per link: velocity of its frame's origin, m per edge.
  const std::vector<Pose>* X_BL_ = nullptr;
};

}  // namespace handway::geometric
