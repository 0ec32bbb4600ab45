#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

namespace handway::planning {

/// Selects the joints of a scene's first robot that a plan moves; make_problem() stores the result.
///
/// The hand is the joints of the basis, in its order, or without a basis the group "hand". The arm
/// is the group "arm", or all other joints. With a group in the scene, both are restricted to it,
/// and the arm is the group without the hand. Without one, the limbs that the goal leaves at the
/// start stay there, and a hand that holds an object keeps its posture, except for joints that the
/// goal moves. If several parts of the robot have the joints of the basis, it is for the hand that
/// the scene's group or the goal moves.
/// @param basis may be null.
/// @throws InputError if the basis names a joint that the robot lacks. @pre the scene has a robot.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::JointSelection select_joints(
    const geometric::Scene& scene, const sampling::PmdBasis* basis);

/// Selects the joints as select_joints(), whatever the goal and the attached objects are: the arm
/// and the hand whose start and goal can be edited. Joints of the basis that the robot lacks are
/// left out.
/// @param basis may be null. @pre the scene has a robot.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::JointSelection select_movable_joints(
    const geometric::Scene& scene, const sampling::PmdBasis* basis);

/// Splits all joints of a robot that is in no scene. Joints of the basis that the robot lacks are
/// left out.
/// @param basis may be null.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::JointSelection select_joints(
    const geometric::RobotModel& model, const sampling::PmdBasis* basis);

}  // namespace handway::planning
