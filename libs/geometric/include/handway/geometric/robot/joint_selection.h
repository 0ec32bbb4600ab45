#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <string_view>
#include <vector>

namespace handway::geometric {

/// The joints of one robot, split by their part in a motion: the same indices for planners, window,
/// command line and devices. Every joint is either in `moving` or in `fixed`.
struct HANDWAY_GEOMETRIC_EXPORT JointSelection {
  JointIndices arm;     ///< Joints of the arm that move, in order.
  JointIndices hand;    ///< Joints of the hand that move, in the order of the hand's basis.
  JointIndices moving;  ///< Joints that may move, ascending: those of Scene::group, or all.
  JointIndices fixed;   ///< Joints that may not move, ascending: they keep the start's values.
  /// Joints of `moving` that belong to a limb that the goal leaves at the start, ascending. They
  /// are in neither arm nor hand; a path that moves them is still valid.
  JointIndices fixed_limb_joints;
  /// Joints of `moving` that hold an attached object, ascending. They are in neither arm nor hand.
  JointIndices holding;
  JointIndices whole_hand;       ///< All joints of the hand, in the order of its basis.
  bool moves_whole_hand = true;  ///< False if some joints of the hand are fixed or hold an object.

  /// Splits the joints of a robot of which everything moves. The hand is the group "hand". The arm
  /// is the group "arm" or, if there is none, every other joint.
  [[nodiscard]] static JointSelection of_groups(const RobotModel& model);
  /// Splits the joints as of_groups(), with other joints for the hand.
  [[nodiscard]] static JointSelection with_hand(const RobotModel& model, JointIndices hand);

  /// Restricts `moving` to some joints, ascending; the others become `fixed`.
  void set_moving(JointIndices joints);

  /// Returns the joints that a plan from `start` to `goal` moves, ascending: those of arm and hand,
  /// and others of `moving` whose values differ.
  [[nodiscard]] JointIndices planned(const Configuration& start, const Configuration& goal) const;

  /// Returns the joints of a part, ascending. @param part "arm" or "hand"; else both.
  [[nodiscard]] JointIndices of_part(std::string_view part) const;

  /// Returns the joints that are in neither arm nor hand, ascending.
  [[nodiscard]] JointIndices outside_arm_and_hand() const;
};

/// One arm of a robot with several, with the hand that it carries.
struct Limb {
  JointIndices arm;   ///< Its own joints, ascending, without those shared by other arms.
  JointIndices hand;  ///< In the order of the selection.
};

/// Returns the limbs of a robot whose arm branches, in the order of the ends of its arms. Joints
/// shared by several arms, such as a torso, belong to none of them. One limb if the arm does not
/// branch.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<Limb> limbs(const RobotModel& model,
                                                               const JointSelection& joints);

}  // namespace handway::geometric
