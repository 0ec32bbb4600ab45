#pragma once

#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::import_kautham {

/// A link and the joint that carries it, in one: modified Denavit-Hartenberg
/// parameters, X_PL(q) = PreTrans * Rx(alpha) Tx(a) Rz(theta + q) Tz(d), or with
/// d + q for a sliding joint.
struct KauthamJoint {
  std::string name;
  std::filesystem::path mesh;  ///< Open Inventor or VRML, mm.
  double alpha = 0.0;          ///< rad
  double a = 0.0;              ///< m
  double theta = 0.0;          ///< rad
  double d = 0.0;              ///< m
  bool rotational = true;
  bool movable = true;
  double lower = 0.0;  ///< rad or m
  double upper = 0.0;  ///< rad or m
  int parent = -1;     ///< Index of a joint further up; -1 for the first.
  geometric::Pose X_PreTrans = geometric::Pose::Identity();
};

/// Moves joints together: eig_value * factors * (c - 0.5) adds to their parameters.
struct KauthamControl {
  std::string name;
  double eig_value = 1.0;   ///< Full side of the control's interval, ≥ 0.
  Eigen::VectorXd factors;  ///< Per joint, as printed: without eig_value.
};

/// What a `.rob` file of Kautham 2013 says.
///
/// A joint's parameter p in [0, 1] spans its range: q = lower + p (upper - lower).
/// Controls c in [0, 1] give p = offset + Σ_j eig_value_j factors_j (c_j - 0.5),
/// clamped to [0, 1].
struct KauthamRobot {
  std::string name;
  std::filesystem::path file;
  std::vector<KauthamJoint> joints;  ///< Parents first; the first one is the root.
  Eigen::VectorXd offset;            ///< Per joint.
  std::vector<KauthamControl> controls;
  int trunk_controls = -1;  ///< How many of the first controls drive the arm; -1: not said.
  std::vector<std::string> warnings;
};

/// @throws InputError naming file, line, element, what was found and expected.
[[nodiscard]] KauthamRobot read_kautham_robot(const std::filesystem::path& file);

/// Does the joint move? Not so if it is declared unmovable or its limits are equal.
[[nodiscard]] bool moves(const KauthamJoint& joint);

/// Parameters p of all joints. @param controls c, shape [controls].
[[nodiscard]] Eigen::VectorXd joint_parameters(const KauthamRobot& robot,
                                               const Eigen::VectorXd& controls);

/// q of one joint, rad or m, from its parameter p.
[[nodiscard]] double joint_value(const KauthamJoint& joint, double parameter);

}  // namespace handway::import_kautham
