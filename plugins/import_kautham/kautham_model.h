#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "inventor_meshes.h"
#include "kautham_problem.h"
#include "kautham_robot.h"

#include <memory>
#include <optional>

namespace handway::import_kautham {

/// Pose of the robot's root link in the frame that its Home places; of a robot whose base moves,
/// the frame itself.
[[nodiscard]] geometric::Pose root_pose(const KauthamRobot& robot);

/// The robot as a kinematic tree. Joints are named after the links they carry.
///
/// A joint that a control set couples rigidly to the one above it (same limits, offset and
/// factors, as the distal finger joints) becomes a `mimic` of it. Groups `arm` and `hand` split
/// the moving joints: the arm's are those that the trunk controls drive, or, without trunk
/// controls, those before the tree branches. Pairs of links that Kautham does not check are
/// allowed to touch: neighbours in the file's order, and the link called Palm with all after
/// it.
///
/// A base that controls move becomes joints before the root: slides X, Y, Z along the axes of the
/// Home, and for moved X1, X2 or X3 rotations `yaw`, `pitch` and `roll`, or `yaw` alone if X3 alone
/// moves an upright robot. They belong to the arm.
/// @param scale of the meshes. @param limits of the base, in the world. @param X_WH the Home.
/// @throws InputError for a mesh that can't be read.
[[nodiscard]] std::shared_ptr<const geometric::RobotModel> make_robot_model(
    const KauthamRobot& robot, double scale, const BaseLimits& limits, const geometric::Pose& X_WH,
    InventorMeshes& meshes);

/// Converts a URDF robot of a later version to its controls: a joint for each link, by the link's
/// name, as Kautham calls them.
[[nodiscard]] KauthamRobot controlled_robot(const geometric::RobotModel& model);

/// The hand's controls as a PMD basis: joints are the group `hand` without coupled ones, a control
/// of a single joint is a free joint, any other a principal direction as printed; λ = eigValue / 2.
/// Null if no control drives the hand.
/// @param[out] warnings gets what a basis can't express.
[[nodiscard]] std::shared_ptr<const sampling::PmdBasis> make_hand_basis(
    const KauthamRobot& robot, const geometric::RobotModel& model,
    std::vector<std::string>& warnings);

/// The configuration at the given controls. @param controls shape [robot.controls].
/// @param limits, X_WH as in make_robot_model().
[[nodiscard]] geometric::Configuration configuration_at(const KauthamRobot& robot,
                                                        const geometric::RobotModel& model,
                                                        const Eigen::VectorXd& controls,
                                                        const BaseLimits& limits,
                                                        const geometric::Pose& X_WH);

}  // namespace handway::import_kautham
