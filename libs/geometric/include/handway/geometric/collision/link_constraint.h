#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace handway::geometric {

/// A PathConstraint in terms of the link that carries its body.
///
/// Its slack is the remaining angle (rad) or, for a position, the distance from the nearest side of
/// the box (m): at least 0 where the constraint holds. When the joints move, it changes by at most
/// the rotation of the axis or the travel of the point.
class HANDWAY_GEOMETRIC_EXPORT LinkConstraint {
 public:
  /// @param scene has a robot; the constraint is of the first one.
  /// @throws InputError if the body is neither an object on that robot nor one of its links.
  LinkConstraint(const PathConstraint& constraint, const Scene& scene);

  [[nodiscard]] const std::string& name() const { return constraint_.name; }
  [[nodiscard]] int link() const { return link_; }
  /// Returns whether the constraint is about a direction (and not a point) of the link.
  [[nodiscard]] bool is_orientation() const {
    return std::holds_alternative<OrientationConstraint>(constraint_.what);
  }
  /// The unit axis or the point (m) in the link's frame.
  [[nodiscard]] const Eigen::Vector3d& held() const { return held_; }

  /// @param X_BL link poses in the robot's base, as RobotModel::forward_kinematics gives them.
  /// @returns rad or m; negative where the constraint is violated.
  [[nodiscard]] double slack(const std::vector<Pose>& X_BL) const;

  /// An amount (rad or m) by which the constraint is exceeded, and its rate as the link moves:
  /// linear · v + angular · ω, where v is the velocity of the link's point at the base's origin.
  /// All in the robot's base.
  struct Excess {
    double amount;
    Eigen::Vector3d linear;
    Eigen::Vector3d angular;
  };
  /// Adds the excess over the constraint made narrower by `inset`, a share of its angle or half
  /// size: the angle, or each side of the box that the point is beyond.
  void add_excess(const std::vector<Pose>& X_BL, double inset, std::vector<Excess>& list) const;

  /// Describes the actual and the allowed value, to follow a name: "the axis of can is 12.3° off,
  /// at most 10° are allowed".
  [[nodiscard]] std::string description(const std::vector<Pose>& X_BL) const;

 private:
  [[nodiscard]] const Pose& pose(const std::vector<Pose>& X_BL) const {
    return X_BL[static_cast<std::size_t>(link_)];
  }
  [[nodiscard]] double angle(const std::vector<Pose>& X_BL) const;
  [[nodiscard]] Eigen::Vector3d in_region(const std::vector<Pose>& X_BL) const;

  PathConstraint constraint_;
  int link_ = 0;
  Eigen::Vector3d held_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::UnitZ();  ///< In the base.
  double most_angle_ = 0.0;                               ///< rad
  Eigen::Vector3d half_size_ = Eigen::Vector3d::Zero();
  Pose X_RB_ = Pose::Identity();
};

/// A configuration near `q` that keeps all constraints: damped Gauss-Newton steps, the shortest in
/// normalised joints, within the limits.
/// @param variables those that may change.
/// @returns `q` itself if it keeps them; nothing if a few steps found none.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<Configuration> project_onto_constraints(
    const RobotModel& model, std::span<const LinkConstraint> constraints,
    std::span<const int> variables, Configuration q);

}  // namespace handway::geometric
