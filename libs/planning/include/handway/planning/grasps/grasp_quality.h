#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace handway::planning {

/// A place where a hand pushes on an object, in the object's frame O.
struct GraspContact {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();        ///< m
  Eigen::Vector3d normal_O = Eigen::Vector3d::UnitZ();  ///< Into the object; of length 1.
};

/// Forces that a contact transmits: a push along its normal and friction (Coulomb), and for a soft
/// finger a torque about the normal.
///
/// Source: Murray, Li, Sastry, "A Mathematical Introduction to Robotic Manipulation", 1994, section
/// 5.2.
struct ContactModel {
  double friction = 0.6;  ///< Coefficient, > 0.
  /// Radius (m) of the disc that a soft finger touches with. With an even pressure the torque about
  /// the normal is at most 2/3 · friction · radius of the normal force. 0 is a hard finger.
  double patch_radius = 0.005;
  int edges = 8;  ///< Edges of the pyramid inside the friction cone, at least 3.

  /// Largest torque about the normal for a normal force of 1 N, N·m.
  [[nodiscard]] double torsion() const { return 2.0 / 3.0 * friction * patch_radius; }
};

/// The point that torques are taken about, and the length that makes them comparable with forces.
struct TorqueScale {
  Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();  ///< The centre of mass.
  double length = 1.0;  ///< m, > 0: the object's largest distance from its centre of mass.
};

/// The scale of an object: about the centre of mass of an even density, of a closed mesh inside it,
/// of an open one on its surface; its length is the largest distance of a vertex from there.
/// @throws std::invalid_argument for a mesh without triangles or extent.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TorqueScale torque_scale(const geometric::TriangleMesh& mesh);

/// Force (N) and torque divided by TorqueScale::length (N), on the object in its frame.
using Wrench = Eigen::Matrix<double, 6, 1>;
/// Several wrenches, one a column.
using Wrenches = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Wrenches of the extreme forces of each contact for a normal force of 1 N: one column for each
/// edge of the friction pyramid, and two more for the torsion of a soft finger. The first edge
/// points along tangent(normal).
/// @throws std::invalid_argument for a model, scale or normal outside of its range.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Wrenches contact_wrenches(
    std::span<const GraspContact> contacts, const ContactModel& model, const TorqueScale& scale);

/// The direction across `normal` that contact_wrenches() begins with; of length 1.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::Vector3d tangent(const Eigen::Vector3d& normal);

/// Quality of a grasp by its wrench space, the convex hull of its contacts' wrenches: all wrenches
/// that the contacts can apply while their normal forces sum up to 1 N.
///
/// Source: C. Ferrari, J. Canny, "Planning optimal grasps", IEEE Int. Conf. on Robotics and
/// Automation, 1992, section 4 (the hull of the union, metric L1); the volume: A. T. Miller, P. K.
/// Allen, "Examples of 3D grasp quality computations", ICRA 1999.
struct GraspQuality {
  /// Radius (N) of the largest ball about the origin in the wrench space: the size of the smallest
  /// disturbance that the grasp cannot resist with 1 N. At most 0: some disturbance, however small,
  /// moves the object. Negative: the origin is outside, by that much of the farthest facet's plane.
  double epsilon = 0.0;
  double volume = 0.0;  ///< N⁶; 0 for a wrench space without six dimensions.
  /// The disturbance that the grasp resists least; of length 1, or 0 without six dimensions.
  Wrench weakest = Wrench::Zero();
};

/// The quality of a grasp with these wrenches; epsilon and volume are 0 if they span less than six
/// dimensions.
/// @throws std::invalid_argument for a wrench that is not finite.
[[nodiscard]] HANDWAY_PLANNING_EXPORT GraspQuality grasp_quality(const Wrenches& wrenches);

/// Returns an upper bound of GraspQuality::epsilon, for most grasps epsilon itself, without the
/// cost of the hull: the least that the wrench space reaches in a few hundred directions, and at
/// the ends of walks over its facets that begin at the least of these.
/// @throws as grasp_quality().
[[nodiscard]] HANDWAY_PLANNING_EXPORT double epsilon_bound(const Wrenches& wrenches);

/// The contact forces with the least sum of squares that balance `load`.
/// @param load on the object, about scale.centre_O; gravity acts as (m·g, 0).
/// @returns a force (N) on the object for each contact, in its frame; nothing if no forces within
/// the friction pyramids balance the load.
/// @throws std::invalid_argument as contact_wrenches().
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<std::vector<Eigen::Vector3d>>
least_contact_forces(std::span<const GraspContact> contacts, const ContactModel& model,
                     const TorqueScale& scale, const Wrench& load);

/// The contact forces with the least sum of squares that balance each other while their normal
/// forces sum up to 1 N: how a grasp squeezes.
/// @returns as least_contact_forces().
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<std::vector<Eigen::Vector3d>>
internal_contact_forces(std::span<const GraspContact> contacts, const ContactModel& model,
                        const TorqueScale& scale);

}  // namespace handway::planning
