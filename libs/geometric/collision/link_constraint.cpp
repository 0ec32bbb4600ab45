#include "handway/geometric/collision/link_constraint.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::geometric {
namespace {

struct Carrier {
  int link;
  Pose X_LB;  ///< The body in the link.
};

Carrier carrier_of(const PathConstraint& constraint, const Scene& scene) {
  const RobotInstance& robot = scene.robots.front();
  const SceneObject* object = find_object(scene, constraint.body);
  if (object && is_carried_by(*object, robot)) {
    return {*robot.model->find_link(object->attachment->link), object->X_PO};
  }
  if (const auto link = robot.model->find_link(constraint.body)) {
    return {*link, Pose::Identity()};
  }
  throw InputError({scene.file.string(), "constraint " + constraint.name,
                    constraint.body + (object ? ", which " + robot.name + " does not carry"
                                              : ", which is not in the scene"),
                    "an object on a link of " + robot.name + ", or one of its links",
                    object ? "Attach the object, or remove the constraint"
                           : advise_name(constraint.body, constrainable_bodies(scene))});
}

// Unit vector; any normal of `axis` if the other is parallel.
Eigen::Vector3d across(const Eigen::Vector3d& axis, const Eigen::Vector3d& other) {
  const Eigen::Vector3d normal = axis.cross(other);
  return normal.norm() > 1e-9 ? normal.normalized() : axis.unitOrthogonal();
}

// Returns excesses and their slopes in normalised joints. Shapes [excesses x variables],
// [excesses].
std::pair<Eigen::MatrixXd, Eigen::VectorXd> excess_of(const RobotModel& model,
                                                      std::span<const LinkConstraint> constraints,
                                                      std::span<const int> variables,
                                                      const std::vector<Pose>& X_BL, double inset) {
  std::vector<LinkConstraint::Excess> list;
  LinkIndices links;
  for (const LinkConstraint& constraint : constraints) {
    constraint.add_excess(X_BL, inset, list);
    links.resize(list.size(), constraint.link());
  }
  const auto rows = static_cast<Eigen::Index>(list.size());
  Eigen::MatrixXd by_variable = Eigen::MatrixXd::Zero(rows, model.variable_count());
  Eigen::VectorXd amounts(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const LinkConstraint::Excess& excess = list[static_cast<std::size_t>(row)];
    amounts[row] = excess.amount;
    for (int link = links[static_cast<std::size_t>(row)]; link > 0; link = model.parent(link)) {
      const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
      if (drive.variable < 0) {
        continue;
      }
      const Pose& X_BJ = X_BL[static_cast<std::size_t>(link)];
      const Eigen::Vector3d axis = X_BJ.linear() * model.joint(link).axis;
      by_variable(row, drive.variable) +=
          drive.multiplier *
          (model.joint(link).type == JointType::kPrismatic
               ? excess.linear.dot(axis)
               : excess.linear.dot(X_BJ.translation().cross(axis)) + excess.angular.dot(axis));
    }
  }
  Eigen::MatrixXd slopes(rows, static_cast<Eigen::Index>(variables.size()));
  for (std::size_t i = 0; i < variables.size(); ++i) {
    slopes.col(static_cast<Eigen::Index>(i)) =
        (model.upper() - model.lower())[variables[i]] * by_variable.col(variables[i]);
  }
  return {slopes, amounts};
}

}  // namespace

LinkConstraint::LinkConstraint(const PathConstraint& constraint, const Scene& scene)
    : constraint_(constraint) {
  const Carrier carrier = carrier_of(constraint, scene);
  const Pose& X_WB = scene.robots.front().X_WB;
  link_ = carrier.link;
  if (const auto* orientation = std::get_if<OrientationConstraint>(&constraint.what)) {
    held_ = carrier.X_LB.linear() * orientation->axis.normalized();
    direction_ = X_WB.linear().transpose() * orientation->direction.normalized();
    most_angle_ = orientation->angle;
  } else {
    const auto& position = std::get<PositionConstraint>(constraint.what);
    held_ = carrier.X_LB * position.point;
    half_size_ = 0.5 * position.size;
    X_RB_ = position.X_WR.inverse() * X_WB;
  }
}

double LinkConstraint::angle(const std::vector<Pose>& X_BL) const {
  const Eigen::Vector3d axis = pose(X_BL).linear() * held_;
  return std::atan2(axis.cross(direction_).norm(), axis.dot(direction_));
}

Eigen::Vector3d LinkConstraint::in_region(const std::vector<Pose>& X_BL) const {
  return X_RB_ * (pose(X_BL) * held_);
}

double LinkConstraint::slack(const std::vector<Pose>& X_BL) const {
  return is_orientation() ? most_angle_ - angle(X_BL)
                          : (half_size_ - in_region(X_BL).cwiseAbs()).minCoeff();
}

void LinkConstraint::add_excess(const std::vector<Pose>& X_BL, double inset,
                                std::vector<Excess>& list) const {
  if (is_orientation()) {
    const double amount = angle(X_BL) - (1.0 - inset) * most_angle_;
    if (amount > 0.0) {
      const Eigen::Vector3d axis = pose(X_BL).linear() * held_;
      list.push_back({amount, Eigen::Vector3d::Zero(), -across(axis, direction_)});
    }
    return;
  }
  const Eigen::Vector3d p = pose(X_BL) * held_;
  const Eigen::Vector3d p_R = in_region(X_BL);
  for (int i = 0; i < 3; ++i) {
    const double amount = std::abs(p_R[i]) - (1.0 - inset) * half_size_[i];
    if (amount > 0.0) {
      const Eigen::Vector3d outwards =
          std::copysign(1.0, p_R[i]) * X_RB_.linear().row(i).transpose();
      list.push_back({amount, outwards, p.cross(outwards)});
    }
  }
}

std::string LinkConstraint::description(const std::vector<Pose>& X_BL) const {
  if (is_orientation()) {
    return fmt::format("the axis of {} is {:.2f}° off, at most {:g}° are allowed", constraint_.body,
                       degrees(angle(X_BL)), degrees(most_angle_));
  }
  const Eigen::Vector3d p = in_region(X_BL);
  int worst = 0;
  (p.cwiseAbs() - half_size_).maxCoeff(&worst);
  return fmt::format(
      "the point of {} is at {} = {:.4f} m in the region's frame, at most ±{:g} m are allowed",
      constraint_.body, "xyz"[worst], p[worst], half_size_[worst]);
}

std::optional<Configuration> project_onto_constraints(const RobotModel& model,
                                                      std::span<const LinkConstraint> constraints,
                                                      std::span<const int> variables,
                                                      Configuration q) {
  constexpr int kMostSteps = 10;
  constexpr double kInset = 0.1;     // of what is allowed: room for the edges from there
  constexpr double kDamping = 1e-4;  // of the squared slope in normalised joints
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  const Configuration range = model.upper() - model.lower();
  const auto keeps = [&](const LinkConstraint& constraint) {
    return constraint.slack(X_BL) >= 0.0;
  };
  for (int step = 0; step <= kMostSteps; ++step) {
    model.forward_kinematics(q, X_BL);
    if (std::ranges::all_of(constraints, keeps)) {
      return q;
    }
    const auto [slopes, amounts] = excess_of(model, constraints, variables, X_BL, kInset);
    const Eigen::MatrixXd squared = slopes * slopes.transpose();
    const Eigen::MatrixXd damped =
        squared + kDamping * Eigen::MatrixXd::Identity(squared.rows(), squared.cols());
    const Eigen::VectorXd change = -slopes.transpose() * damped.ldlt().solve(amounts);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const int v = variables[i];
      const JointLimits& limits = model.variable(v).limits;
      q[v] = std::clamp(q[v] + range[v] * change[static_cast<Eigen::Index>(i)], limits.lower,
                        limits.upper);
    }
  }
  return std::nullopt;
}

}  // namespace handway::geometric
