#pragma once

#include "handway/geometric/math/pose.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_kautham {

/// A link together with its joint: modified Denavit-Hartenberg parameters, X_PL(q) =
/// PreTrans * Rx(alpha) Tx(a) Rz(theta + q) Tz(d), or with d + q for a sliding
/// joint.
struct KauthamJoint {
  std::string name;
  std::filesystem::path mesh;            ///< Open Inventor or VRML, mm.
  std::filesystem::path collision_mesh;  ///< For collisions; empty: `mesh`.
  double alpha = 0.0;                    ///< rad
  double a = 0.0;                        ///< m
  double theta = 0.0;                    ///< rad
  double d = 0.0;                        ///< m
  bool rotational = true;
  bool movable = true;
  double lower = 0.0;  ///< rad or m
  double upper = 0.0;  ///< rad or m
  int parent = -1;     ///< Index of a joint further up; -1 for the first.
  geometric::Pose X_PreTrans = geometric::Pose::Identity();
};

/// Parameters of the base: x, y and z, then X1, X2, X3, which make a rotation (see base_pose()).
using BaseParameters = Eigen::Matrix<double, 6, 1>;

/// Couples joints: eig_value * factors * (c - 0.5) is added to their parameters.
struct KauthamControl {
  std::string name;
  double eig_value = 1.0;                        ///< Full side of the control's interval, ≥ 0.
  Eigen::VectorXd factors;                       ///< Per joint, as printed: without eig_value.
  BaseParameters base = BaseParameters::Zero();  ///< Factors of the base.
};

/// Contents of a `.rob` file of Kautham 2013, or of a `.dh` file of later versions.
///
/// A joint's parameter p in [0, 1] spans its range: q = lower + p (upper - lower).
/// Controls c in [0, 1] give p = offset + Σ_j eig_value_j factors_j (c_j - 0.5),
/// clamped to [0, 1].
struct KauthamRobot {
  std::string name;
  std::filesystem::path file;
  std::vector<KauthamJoint> joints;  ///< Parents first; the first one is the root.
  Eigen::VectorXd offset;            ///< Per joint.
  BaseParameters base_offset = BaseParameters::Zero();
  bool has_controls = false;  ///< The file lists them.
  std::vector<KauthamControl> controls;
  int trunk_controls = -1;  ///< Number of the first controls that drive the arm; -1: not given.
  std::vector<std::string> warnings;
};

/// Joints may be in <Joints> or, as in older files, directly in <Robot>.
/// @throws InputError naming file, line, element, the value found and the expected one.
[[nodiscard]] KauthamRobot read_kautham_robot(const std::filesystem::path& file);

/// Reads a `.cntr` file of later versions, which has the controls of all robots of a problem: DOF
/// are called ROBOT/JOINT, or ROBOT/X to ROBOT/X3. Each robot gets all controls, in order, with its
/// own factors; a missing offset is 0.5.
/// @throws InputError as read_kautham_robot().
void read_kautham_controls(const std::filesystem::path& file, std::span<KauthamRobot> robots);

/// Adds Kautham's default controls if a problem of a later version has none: one for each of the
/// base's and the joints' degrees of freedom, robot after robot.
/// @param limits of each robot's base along x, y and z: equal ones are fixed.
void add_default_controls(std::span<KauthamRobot> robots,
                          std::span<const std::array<std::pair<double, double>, 3>> limits);

/// Returns which parameters of the base are moved by a control.
[[nodiscard]] std::array<bool, 6> moving_base(const KauthamRobot& robot);

/// Parameters of the base at the given controls, clamped to [0, 1].
[[nodiscard]] BaseParameters base_parameters(const KauthamRobot& robot,
                                             const Eigen::VectorXd& controls);

/// The rotation of the parameters X1, X2, X3 in [0, 1], uniform over all rotations (Shoemake,
/// "Uniform random rotations", Graphics Gems III, 1992).
[[nodiscard]] Eigen::Quaterniond base_rotation(const BaseParameters& parameters);

/// Returns whether the joint moves: it is declared movable and its limits differ.
[[nodiscard]] bool moves(const KauthamJoint& joint);

/// Parameters p of all joints. @param controls c, shape [controls].
[[nodiscard]] Eigen::VectorXd joint_parameters(const KauthamRobot& robot,
                                               const Eigen::VectorXd& controls);

/// q of one joint, rad or m, from its parameter p.
[[nodiscard]] double joint_value(const KauthamJoint& joint, double parameter);

}  // namespace handway::import_kautham
